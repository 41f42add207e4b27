// What to tell whoever gave an option that does not exist.
#pragma once

#include <string_view>
#include <vector>

namespace coppice {

// Throws option_unknown with where = name: names the one that was probably meant, or says that the option
// does not exist in this version, and lists those that do.
[[noreturn]] void fail_unknown_option(std::string_view name, const std::vector<std::string_view>& known);

}  // namespace coppice
