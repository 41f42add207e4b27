// Numbers out of text, the same on every machine.
#pragma once

#include <cstdint>
#include <optional>
#include <string_view>

namespace coppice {

// The whole text as one finite decimal number ("0.5", "5e-1", "-3"), whatever the locale. Nothing for
// anything else: white space, a comma, a leading +, hexadecimal, inf, nan, a number too large for a double.
std::optional<double> parse_number(std::string_view text);

// The whole text as decimal digits and nothing else; none where the number is not from least to most.
std::optional<uint64_t> parse_whole_number(std::string_view text, uint64_t least = 0,
                                           uint64_t most = UINT64_MAX);

}  // namespace coppice
