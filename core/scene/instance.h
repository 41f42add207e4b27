// Which mesh stands where.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "core/base/watch.h"
#include "core/scene/scene.h"

namespace coppice {

// A mesh placed in the world.
struct Instance {
    uint32_t mesh = 0;      // index into Scene::meshes
    uint32_t node = 0;      // index into Scene::nodes
    uint32_t in_batch = 0;  // index in the node's batch; 0 where it has none
    Transform world = {};   // mesh coordinates to scene coordinates
};

// World transform of every node, in node order. Iterative: depth costs no stack.
std::vector<Transform> world_transforms(const Scene& scene);

// Every instance that the default scene draws, in depth-first order from the roots. Throws asset_malformed
// where one's world transform is not finite: the product of finite ones may be too large for a number.
std::vector<Instance> instances(const Scene& scene, const Watch& watch = {});

// How many instances instances() would give, without making them.
uint64_t instance_count(const Scene& scene);

// World-space bounds of all instances: the box of every transformed position. No side is beyond the exact
// one, or short of it by more than 1e-9 of the diagonal: an instance that cannot reach farther than that is
// not looked at closer, so that thousands of instances cost little. Throws asset_malformed where the box has
// no finite diagonal.
Bounds scene_bounds(const Scene& scene, const Watch& watch = {});
Bounds scene_bounds(const Scene& scene, std::span<const Instance> instances, const Watch& watch = {});

}  // namespace coppice
