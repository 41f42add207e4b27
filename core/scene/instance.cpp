#include "core/scene/instance.h"

#include <array>
#include <cstddef>
#include <limits>

namespace coppice {

namespace {

// Calls visit(node) for every node under the roots, parents first, in depth-first order. No recursion: a
// hostile file may be deep.
template <typename Visit>
void walk(const Scene& scene, const std::vector<uint32_t>& roots, Visit visit) {
    std::vector<uint32_t> stack(roots.rbegin(), roots.rend());
    while (!stack.empty()) {
        const uint32_t node = stack.back();
        stack.pop_back();
        visit(node);
        const auto& children = scene.nodes[node].children;
        stack.insert(stack.end(), children.rbegin(), children.rend());
    }
}

std::vector<uint32_t> all_roots(const Scene& scene) {
    std::vector<uint32_t> roots;
    for (uint32_t n = 0; n < scene.nodes.size(); ++n) {
        if (!scene.nodes[n].parent) roots.push_back(n);
    }
    return roots;
}

}  // namespace

std::vector<Transform> world_transforms(const Scene& scene) {
    std::vector<Transform> world(scene.nodes.size());
    walk(scene, all_roots(scene), [&](uint32_t n) {
        const Node& node = scene.nodes[n];
        world[n] = node.parent ? world[*node.parent] * node.local : node.local;
    });
    return world;
}

std::vector<Instance> instances(const Scene& scene) {
    const std::vector<Transform> world = world_transforms(scene);
    std::vector<Instance> result;
    walk(scene, scene.roots, [&](uint32_t n) {
        const Node& node = scene.nodes[n];
        if (!node.mesh) return;
        if (node.batch.empty()) result.push_back({*node.mesh, n, 0, world[n]});
        for (uint32_t i = 0; i < node.batch.size(); ++i) {
            result.push_back({*node.mesh, n, i, world[n] * node.batch[i]});
        }
    });
    return result;
}

uint64_t instance_count(const Scene& scene) {
    uint64_t count = 0;
    walk(scene, scene.roots, [&](uint32_t n) {
        const Node& node = scene.nodes[n];
        if (node.mesh) count += node.batch.empty() ? 1 : node.batch.size();
    });
    return count;
}

Bounds scene_bounds(const Scene& scene, std::span<const Instance> instances) {
    std::vector<Bounds> local;
    for (const Mesh& mesh : scene.meshes) local.push_back(bounds(mesh.positions));
    const auto is_inside = [](const Bounds& inner, const Bounds& outer) {
        return inner.min.x >= outer.min.x && inner.min.y >= outer.min.y && inner.min.z >= outer.min.z &&
               inner.max.x <= outer.max.x && inner.max.y <= outer.max.y && inner.max.z <= outer.max.z;
    };
    const auto extend_exactly = [&](Bounds& box, const Instance& instance) {
        for (const Vec3f& position : scene.meshes[instance.mesh].positions) {
            box.extend(instance.world.point(to_double(position)));
        }
    };
    std::vector<Bounds> boxes;          // of each instance's corners: never too small
    std::array<size_t, 6> outermost{};  // by those, for each side
    std::array<double, 6> farthest{};
    farthest.fill(-std::numeric_limits<double>::infinity());
    for (size_t i = 0; i < instances.size(); ++i) {
        const Bounds& b = boxes.emplace_back(transform_bounds(instances[i].world, local[instances[i].mesh]));
        const std::array<double, 6> reach = {-b.min.x, -b.min.y, -b.min.z, b.max.x, b.max.y, b.max.z};
        for (size_t side = 0; side < 6; ++side) {
            if (!(reach[side] > farthest[side])) continue;
            farthest[side] = reach[side];
            outermost[side] = i;
        }
    }
    Bounds box;
    if (instances.empty()) return box;
    for (const size_t i : outermost) extend_exactly(box, instances[i]);
    for (size_t i = 0; i < instances.size(); ++i) {
        if (!is_inside(boxes[i], box)) extend_exactly(box, instances[i]);
    }
    return box;
}

Bounds scene_bounds(const Scene& scene) {
    return scene_bounds(scene, instances(scene));
}

}  // namespace coppice
