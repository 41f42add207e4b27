// Which coppice this is: results are equal only for equal engines.
#pragma once

#include <string_view>

namespace coppice {

std::string_view engine_version();  // "0.1.0"
std::string_view engine_build();    // "1a2b3c4d5e6f g++ 12.2.0": commit (or "unknown") and compiler

}  // namespace coppice
