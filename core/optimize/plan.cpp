#include "core/optimize/plan.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "core/base/watched_loop.h"

namespace coppice {

namespace {

double diagonal_of(const Scene& scene, std::span<const Instance> instances, const Watch& watch) {
    if (!instances.empty()) return scene_bounds(scene, instances, watch).diagonal();
    Bounds box;
    for (const Mesh& mesh : scene.meshes) box.extend(bounds(mesh.positions));
    return box.diagonal();
}

bool gives_target(const Algorithm& algorithm, const OptimizeOptions& options) {
    if (options.ratio || options.triangles || options.error) return true;
    return std::any_of(
        algorithm.parameters.begin(), algorithm.parameters.end(), [&](const Parameter& parameter) {
            return parameter.ends_run && options.parameters.contains(std::string(parameter.id));
        });
}

double scale_of(std::span<const Transform> instances, const Watch& watch) {
    double largest = 0;
    for (size_t begin = 0; begin < instances.size(); begin += watched_stride) {
        watch.check();
        const size_t count = std::min(watched_stride, instances.size() - begin);
        largest = std::max(largest, largest_scale(instances.subspan(begin, count)));
    }
    return largest > 0 ? largest : 1;
}

uint64_t share(double ratio, size_t count) {
    return std::max<uint64_t>(1, static_cast<uint64_t>(std::llround(ratio * static_cast<double>(count))));
}

}  // namespace

std::vector<uint64_t> Placement::counts() const {
    std::vector<uint64_t> counts;
    for (const std::vector<Transform>& transforms : of_mesh) counts.push_back(transforms.size());
    return counts;
}

Placement place(const Scene& scene, const Watch& watch) {
    Placement placement;
    placement.instances = instances(scene, watch);
    placement.of_mesh.resize(scene.meshes.size());
    watched_loop(placement.instances.size(), watch, [&](size_t i) {
        const Instance& instance = placement.instances[i];
        placement.of_mesh[instance.mesh].push_back(instance.world);
    });
    for (const std::vector<Transform>& of_one : placement.of_mesh)
        placement.scales.push_back(scale_of(of_one, watch));
    placement.diagonal = diagonal_of(scene, placement.instances, watch);
    return placement;
}

std::vector<uint64_t> split_in_proportion(uint64_t total, std::span<const uint64_t> sizes) {
    const uint64_t sum = std::accumulate(sizes.begin(), sizes.end(), uint64_t{0});
    if (total >= sum) return {sizes.begin(), sizes.end()};
    // One for every non-empty part first, the rest in proportion to what each has beyond that one.
    std::vector<uint64_t> parts;
    for (const uint64_t size : sizes) parts.push_back(std::min<uint64_t>(size, 1));
    const uint64_t given = std::accumulate(parts.begin(), parts.end(), uint64_t{0});
    if (total <= given) return parts;

    std::vector<std::pair<double, size_t>> remainders;
    uint64_t left = total - given;
    const double portion = static_cast<double>(left) / static_cast<double>(sum - given);
    for (size_t i = 0; i < sizes.size(); ++i) {
        if (sizes[i] == 0) continue;
        const double exact = portion * static_cast<double>(sizes[i] - 1);
        const auto whole = std::min({static_cast<uint64_t>(exact), sizes[i] - 1, left});
        parts[i] += whole;
        left -= whole;
        if (parts[i] < sizes[i]) remainders.emplace_back(static_cast<double>(whole) - exact, i);
    }
    std::sort(remainders.begin(), remainders.end());
    for (size_t i = 0; left > 0 && i < remainders.size(); ++i, --left) ++parts[remainders[i].second];
    return parts;
}

SceneTarget plan_scene_target(const Scene& scene, const Placement& placement, const Algorithm& algorithm,
                              const OptimizeOptions& options) {
    SceneTarget target;
    target.of_mesh.resize(scene.meshes.size());
    double drawn = 0;
    for (size_t i = 0; i < scene.meshes.size(); ++i) {
        drawn += static_cast<double>(scene.meshes[i].triangle_count() * placement.of_mesh[i].size());
        if (options.error)
            target.of_mesh[i].error_model_units = *options.error * placement.diagonal / placement.scales[i];
    }
    const std::optional<double> ratio = gives_target(algorithm, options) ? options.ratio : 0.5;
    if (ratio) target.triangles = static_cast<uint64_t>(std::llround(*ratio * drawn));
    if (options.triangles) {
        target.triangles = options.triangles;
        target.rendered = false;
    }
    return target;
}

std::vector<Target> plan_targets(const Scene& scene, const Placement& placement, const Algorithm& algorithm,
                                 const ParameterValues& parameters, const OptimizeOptions& options) {
    const bool counts_vertices = parameters.text("stop") == "vertices";
    const std::optional<double> ratio = gives_target(algorithm, options) ? options.ratio : 0.5;
    std::vector<uint64_t> triangles;
    if (options.triangles) {
        std::vector<uint64_t> sizes;
        for (const Mesh& mesh : scene.meshes) sizes.push_back(mesh.triangle_count());
        triangles = split_in_proportion(*options.triangles, sizes);
    }
    std::vector<Target> targets(scene.meshes.size());
    for (size_t i = 0; i < targets.size(); ++i) {
        const Mesh& mesh = scene.meshes[i];
        if (options.triangles) targets[i].triangles = triangles[i];
        if (ratio && counts_vertices) targets[i].vertices = share(*ratio, mesh.vertex_count());
        if (ratio && !counts_vertices) targets[i].triangles = share(*ratio, mesh.triangle_count());
        if (options.error)
            targets[i].error_model_units = *options.error * placement.diagonal / placement.scales[i];
    }
    return targets;
}

}  // namespace coppice
