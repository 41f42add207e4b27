#include "core/base/number.h"

#include <charconv>
#include <cmath>

namespace coppice {
namespace {

template <typename Number>
std::optional<Number> parse(std::string_view text) {
    Number value{};
    const char* end = text.data() + text.size();
    const auto [stopped, error] = std::from_chars(text.data(), end, value);
    if (error != std::errc() || stopped != end) return {};
    return value;
}

}  // namespace

std::optional<double> parse_number(std::string_view text) {
    const auto value = parse<double>(text);
    return value && std::isfinite(*value) ? value : std::nullopt;
}

std::optional<uint64_t> parse_whole_number(std::string_view text, uint64_t least, uint64_t most) {
    const auto value = parse<uint64_t>(text);
    return value && *value >= least && *value <= most ? value : std::nullopt;
}

}  // namespace coppice
