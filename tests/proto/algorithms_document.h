// docs/algorithms.md, as the registry has it.
#pragma once

#include <string>

namespace coppice {

std::string algorithms_document();

}  // namespace coppice
