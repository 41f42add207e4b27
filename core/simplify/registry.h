// Every algorithm, once.
#pragma once

#include <span>
#include <string_view>

#include "core/simplify/algorithm.h"

namespace coppice {

std::span<const Algorithm> algorithms();  // in the order they are listed to users
const Algorithm& default_algorithm();
const Algorithm& find_algorithm(std::string_view id);  // throws option_invalid that lists the ids

}  // namespace coppice
