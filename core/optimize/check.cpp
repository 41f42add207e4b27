#include "core/optimize/check.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace coppice {

namespace {

// One warning for all meshes it concerns, naming the first: a scene may have tens of thousands.
class Concerned {
  public:
    void add(size_t mesh, const Scene& scene) {
        if (count_++ == 0) {
            const std::string& name = scene.meshes[mesh].name;
            first_ = fmt::format("mesh {}{}", mesh, name.empty() ? "" : fmt::format(" \"{}\"", name));
            where_ = fmt::format("meshes[{}]", mesh);
        }
    }
    void report(std::vector<Warning>& warnings, std::string_view code, std::string_view what) const {
        if (count_ == 0) return;
        std::string message = count_ == 1 ? fmt::format("{} {}", first_, what)
                                          : fmt::format("{} and {} more {}", first_, count_ - 1, what);
        warnings.push_back({std::string(code), std::move(message), where_});
    }

  private:
    size_t count_ = 0;
    std::string first_, where_;
};

bool missed_target(const Simplified& simplified, const Target& target) {
    if (simplified.stop_reason == StopReason::target || simplified.stop_reason == StopReason::already_smaller)
        return false;
    return (target.triangles && simplified.mesh.triangle_count() > *target.triangles) ||
           (target.vertices && simplified.mesh.vertex_count() > *target.vertices);
}

double box_moved(const Mesh& before, const Mesh& after) {
    const Bounds a = bounds(before.positions), b = bounds(after.positions);
    if (a.empty() || b.empty()) return 0;
    const Vec3d low = b.min - a.min, high = b.max - a.max;
    return std::max({std::abs(low.x), std::abs(low.y), std::abs(low.z), std::abs(high.x), std::abs(high.y),
                     std::abs(high.z)});
}

bool moves(const Scene& scene, uint32_t node) {
    for (std::optional<uint32_t> n = node; n; n = scene.nodes[*n].parent) {
        if (scene.nodes[*n].animated) return true;
    }
    return false;
}

void check_pose(const Scene& scene, const Placement& placement, std::vector<Warning>& warnings) {
    Concerned deforming, moving;
    std::vector<bool> deforms(scene.meshes.size(), false), is_moving(scene.meshes.size(), false);
    for (size_t i = 0; i < scene.meshes.size(); ++i) deforms[i] = !scene.meshes[i].morph_targets.empty();
    for (const Instance& instance : placement.instances) {
        if (scene.nodes[instance.node].skinned) deforms[instance.mesh] = true;
        if (!is_moving[instance.mesh] && moves(scene, instance.node)) is_moving[instance.mesh] = true;
    }
    for (size_t i = 0; i < scene.meshes.size(); ++i) {
        if (deforms[i]) deforming.add(i, scene);
        if (is_moving[i] && !deforms[i]) moving.add(i, scene);
    }
    deforming.report(warnings, "error.rest_pose_only",
                     "is skinned or has morph targets: the error limit holds in the rest pose");
    moving.report(
        warnings, "error.rest_pose_only",
        "is moved by an animation: the error limit holds at the scale that the nodes have outside of it");
}

}  // namespace

std::vector<Warning> check_result(const Scene& before, const Placement& placement,
                                  const std::vector<Target>& targets,
                                  const std::vector<Simplified>& simplified, const OptimizeOptions& options) {
    Concerned missed, vanished, moved;
    for (size_t i = 0; i < simplified.size(); ++i) {
        if (missed_target(simplified[i], targets[i])) missed.add(i, before);
        const bool had_triangles = before.meshes[i].triangle_count() > 0;
        if (had_triangles && simplified[i].mesh.triangle_count() == 0) {
            vanished.add(i, before);
        } else if (had_triangles && !placement.of_mesh[i].empty() &&
                   box_moved(before.meshes[i], simplified[i].mesh) * placement.scales[i] >
                       0.01 * placement.diagonal) {
            moved.add(i, before);
        }
    }
    std::vector<Warning> warnings;
    missed.report(warnings, "target.not_reached",
                  "kept more than the target asks; see stop_reason in the report's meshes");
    vanished.report(warnings, "mesh.vanished", "has no triangle left");
    moved.report(warnings, "bounds.changed",
                 "changed its bounding box by more than 1 % of the scene's diagonal");
    if (options.error) check_pose(before, placement, warnings);
    return warnings;
}

}  // namespace coppice
