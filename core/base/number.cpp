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

std::optional<uint64_t> parse_whole_number(std::string_view text) {
    return parse<uint64_t>(text);
}

}  // namespace coppice
