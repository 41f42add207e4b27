// What is looked at before an answer goes out. For use inside core/optimize.
#pragma once

#include <vector>

#include "core/optimize/plan.h"

namespace coppice {

// Warnings about outcomes that the caller may not expect:
// target.not_reached (topology, the error limit or a lock stopped it first), mesh.vanished, bounds.changed
// (an instance's box moved by more than 1 % of the scene's diagonal), error.rest_pose_only (an error limit on
// what moves or deforms).
std::vector<Warning> check_result(const Scene& before, const Placement& placement,
                                  const std::vector<Target>& targets,
                                  const std::vector<Simplified>& simplified, const OptimizeOptions& options);

}  // namespace coppice
