// The simplify stage: every unique mesh once, in parallel. For use inside core/optimize.
#pragma once

#include <vector>

#include "core/optimize/plan.h"

namespace coppice {

// Results in mesh order, the same for any number of threads. Its cost does not depend on the number of
// instances but for one pass over their transforms. Throws job_cancelled.
std::vector<Simplified> simplify_meshes(const std::vector<Mesh>& meshes, const Placement& placement,
                                        const std::vector<Target>& targets, const Algorithm& algorithm,
                                        const ParameterValues& parameters, unsigned threads,
                                        const Watch& watch);

}  // namespace coppice
