// How far a mesh is from its target.
#pragma once

#include "core/mesh/mesh.h"
#include "core/simplify/algorithm.h"
#include "core/simplify/collapse_mesh.h"

namespace coppice {

// Nothing to do. An empty mesh is always small enough.
bool is_small_enough(const Mesh& mesh, const Target& target);

// Whether there is anything to reach.
inline bool is_set(const Target& target) {
    return target.triangles || target.vertices || target.error_model_units;
}

// Triangles at which the target will be met, about: a vertex less is two triangles less. 0 without a count.
double triangles_when_met(const Target& target, const CollapseMesh& mesh);

// The mesh as it is, without what no triangle uses.
Simplified already_smaller(const Mesh& mesh, const Watch& watch);

// Counts down from where a mesh starts to its target.
class TargetCount {
  public:
    // Keeps a reference to the target.
    TargetCount(const Target& target, const CollapseMesh& mesh)
        : target_(target), triangles_(mesh.live_triangles()), vertices_(mesh.live_vertices()) {}

    bool is_met(const CollapseMesh& mesh) const;      // at or below the target's triangles and vertices
    double fraction(const CollapseMesh& mesh) const;  // of the way there, 0..1

  private:
    const Target& target_;
    uint32_t triangles_, vertices_;  // at the start
};

}  // namespace coppice
