#include "cli/terminal.h"

#include <fmt/format.h>

#include <array>

namespace coppice {

std::string print_bytes(uint64_t bytes) {
    constexpr std::array units = {"B", "KB", "MB", "GB", "TB"};
    auto value = static_cast<double>(bytes);
    size_t unit = 0;
    for (; value >= 1000 && unit + 1 < units.size(); ++unit) value /= 1000;
    return unit == 0 ? fmt::format("{} B", bytes) : fmt::format("{:.1f} {}", value, units[unit]);
}

std::string print_count(uint64_t count) {
    std::string digits = std::to_string(count);
    for (size_t i = digits.size(); i > 3; i -= 3) digits.insert(i - 3, ",");
    return digits;
}

std::string print_count(uint64_t count, std::string_view one, std::string_view many) {
    return fmt::format("{} {}", print_count(count), count == 1 ? one : many);
}

}  // namespace coppice
