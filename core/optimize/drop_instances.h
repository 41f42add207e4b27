// What an algorithm drops of a scene, taken out of it and told. For use inside core/optimize.
#pragma once

#include <cstdint>
#include <vector>

#include "core/optimize/plan.h"
#include "core/optimize/report.h"

namespace coppice {

// dropped: per mesh, which of its instances, ascending; or empty. Returns them in scene order.
std::vector<PrunedInstance> drop_instances(Scene& scene, const Placement& placement,
                                           const std::vector<std::vector<uint32_t>>& dropped);

Warning pruned_warning(size_t pruned, size_t given);

}  // namespace coppice
