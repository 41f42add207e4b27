// The commands of the binary. Each adds itself to the parser; what it does when chosen is kept in the
// returned action.
#pragma once

#include <functional>

#include "cli/terminal.h"

namespace CLI {
class App;
}

namespace coppice {

using Action = std::function<int()>;  // -> exit code

// The terminal must outlive the action.
Action add_optimize(CLI::App& app, const Terminal& terminal);
Action add_inspect(CLI::App& app, const Terminal& terminal);
Action add_compare(CLI::App& app, const Terminal& terminal);
Action add_algorithms(CLI::App& app, const Terminal& terminal);
Action add_sample(CLI::App& app, const Terminal& terminal);
Action add_serve(CLI::App& app, const Terminal& terminal);

}  // namespace coppice
