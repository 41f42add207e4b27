// Numbers out of text, the same on every machine.
#pragma once

#include <cstdint>
#include <optional>
#include <string_view>

namespace coppice {

// The whole text as one finite decimal number ("0.5", "5e-1", "-3"), whatever the locale. Nothing for
// anything else: white space, a comma, a leading +, hexadecimal, inf, nan, a number too large for a double.
std::optional<double> parse_number(std::string_view text);

// The whole text as decimal digits and nothing else; none where the number has more than 64 bits.
std::optional<uint64_t> parse_whole_number(std::string_view text);

}  // namespace coppice
