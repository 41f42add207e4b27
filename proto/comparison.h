// A comparison as JSON.
#pragma once

#include <string>

#include "core/optimize/compare.h"

namespace coppice {

std::string print_comparison(const Comparison& comparison);

}  // namespace coppice
