// The whole command line, for main and for tests.
#pragma once

#include <string>
#include <vector>

#include "cli/terminal.h"

namespace coppice {

// arguments: without the program's name. Exit codes: 0 done, 1 the work failed, 2 wrong usage. Throws
// nothing.
int run(const std::vector<std::string>& arguments, const Terminal& terminal);

}  // namespace coppice
