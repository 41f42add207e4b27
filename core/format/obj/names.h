// Names that fit on a line of OBJ.
#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace coppice {

// Without line ends, control characters and blanks around it; fallback where nothing is left.
std::string line_name(std::string_view name, std::string_view fallback);

// line_name of each, made unique by "-2", "-3", ...
std::vector<std::string> unique_line_names(std::span<const std::string> names, std::string_view fallback);

}  // namespace coppice
