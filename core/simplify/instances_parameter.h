// The parameter of algorithms that know no instances. core/optimize reads it.
#pragma once

#include <array>

#include "core/simplify/parameter.h"

namespace coppice {

inline Parameter instances_parameter() {
    static constexpr std::array<std::string_view, 2> choices = {"share", "expand"};
    return {
        .id = "instances",
        .title = "share simplifies each unique mesh once; expand a copy for each instance, as the papers do",
        .kind = Parameter::Kind::choice,
        .default_value = "share",
        .choices = choices};
}

}  // namespace coppice
