// Stochastic pruning of instances, an option of ias: where collapses end short of a target in drawn
// triangles, some of the instances of what stands very often go, and those that stay grow.
//
// As the author of IAS does it in Sirikata, by his description of the code: only meshes with at least 1000
// instances and 5 % of all lose any; chance says which, after those that would reach out of the scene's box
// once they have grown; the ones that stay are scaled by sqrt(1 / share that stays), so that they cover what
// all did.
//
// Departures: the mesh is scaled, about its origin, in place of the transforms that show it, so that nodes
// and their children stay as they are; nodes outside the default scene that show it grow with it. Meshes with
// morph targets or joints, and those that would outgrow what numbers reach, keep all instances. Chance is
// seeded.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "core/base/watch.h"
#include "core/scene/transform.h"
#include "core/simplify/algorithm.h"

namespace coppice {

// How many drawn triangles the meshes may keep together, and what chance starts with.
struct PruneTarget {
    uint64_t rendered_triangles = 0;
    uint64_t seed = 1;
};

// Drops no more instances than it takes, in the same proportion of each mesh that may lose some; at least one
// of each stays. Enlarges those meshes. Returns which instances go: per mesh, ascending. O(instances).
std::vector<std::vector<uint32_t>> prune_instances(std::span<Simplified> meshes,
                                                   std::span<const std::vector<Transform>> instances,
                                                   const PruneTarget& target, const Watch& watch);

}  // namespace coppice
