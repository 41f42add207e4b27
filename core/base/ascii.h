// Text of protocols and file formats, which is ASCII where it has a meaning: the same in every locale. Bytes
// beyond ASCII are left as they are.
#pragma once

#include <string>
#include <string_view>

namespace coppice {

std::string lower(std::string_view text);
bool equal_ignoring_case(std::string_view a, std::string_view b);

// Without the blanks at both ends.
std::string_view trim(std::string_view text, std::string_view blanks = " \t");

}  // namespace coppice
