// What a flag that takes a count is checked with.
#pragma once

#include <string>

namespace coppice {

// For CLI::Option::check: empty where the text is a whole number of at least 0, else what is wrong. CLI11
// itself takes -1 for an unsigned number and lets it wrap around.
std::string check_count(const std::string& text);

}  // namespace coppice
