// Which instance of a candidate stands where one of the reference does.
#pragma once

#include <optional>
#include <vector>

#include "core/base/watch.h"
#include "core/compare/moments.h"
#include "core/scene/instance.h"

namespace coppice {

// Two scenes that place the same meshes at the same places: what coppice makes of a scene, which keeps
// indices of nodes and meshes. Mesh i of the one is meant to be mesh i of the other.
struct Correspondence {
    std::vector<InstanceWeight> weights;  // per mesh
    std::vector<uint64_t> counts;         // per mesh: its instances
};

// None where the scenes differ in the number of meshes or instances, in the mesh of an instance, in a
// transform by more than 1e-6, or where a mesh has triangles in one of them alone.
std::optional<Correspondence> find_correspondence(const Scene& reference,
                                                  const std::vector<Instance>& of_reference,
                                                  const Scene& candidate,
                                                  const std::vector<Instance>& of_candidate,
                                                  const Watch& watch);

// What an instance adds to the weight of its mesh. Lengths are taken times the largest factor by which the
// transform stretches anything, areas times the square of its mean factor. For similarities, which is what
// instances mostly are, both are exact. Where the scale is not uniform, a distance in the world is never
// longer than that of its mesh times the factor, so that the largest is an upper bound, and mean and root
// mean square are on the safe side as well.
void add_instance(InstanceWeight& weight, const Transform& world);

}  // namespace coppice
