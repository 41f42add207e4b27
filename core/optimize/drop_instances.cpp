#include "core/optimize/drop_instances.h"

#include <fmt/format.h>

#include <span>

#include "core/scene/remove_instances.h"

namespace coppice {

std::vector<PrunedInstance> drop_instances(Scene& scene, const Placement& placement,
                                           const std::vector<std::vector<uint32_t>>& dropped) {
    if (dropped.empty()) return {};
    std::vector<std::span<const uint32_t>> to_come(dropped.begin(), dropped.end());
    std::vector<uint32_t> seen(dropped.size(), 0);
    std::vector<Instance> gone;
    std::vector<PrunedInstance> pruned;
    for (const Instance& instance : placement.instances) {
        const uint32_t number = seen[instance.mesh]++;
        std::span<const uint32_t>& next = to_come[instance.mesh];
        if (next.empty() || next.front() != number) continue;
        next = next.subspan(1);
        gone.push_back(instance);
        pruned.push_back({instance.node, instance.in_batch});
    }
    remove_instances(scene, gone);
    return pruned;
}

Warning pruned_warning(size_t pruned, size_t given) {
    return {"instances.pruned",
            fmt::format("{} of {} instances were dropped to meet the target, and the others of their meshes "
                        "enlarged; see pruned in the report's instancing",
                        pruned, given),
            "parameters.prune_instances", pruned};
}

}  // namespace coppice
