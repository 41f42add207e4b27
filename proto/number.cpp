#include "proto/number.h"

#include <charconv>
#include <cmath>

namespace coppice {

std::optional<double> parse_number(std::string_view text) {
    double value = 0;
    const char* end = text.data() + text.size();
    const auto [stopped, error] = std::from_chars(text.data(), end, value);
    if (error != std::errc() || stopped != end || !std::isfinite(value)) return {};
    return value;
}

}  // namespace coppice
