// Runs one algorithm on one mesh that stands once, as tests of algorithms do.
#pragma once

#include <map>
#include <string>

#include "core/simplify/algorithm.h"

namespace coppice::test {

using Parameters = std::map<std::string, ParameterValue>;

inline Simplified run_algorithm(const Algorithm& algorithm, const Mesh& mesh, const Target& target,
                                const Parameters& parameters = {}) {
    return algorithm.simplify(mesh, {}, target, ParameterValues::parse(algorithm.parameters, parameters), {});
}

}  // namespace coppice::test
