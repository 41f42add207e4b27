// The triangles of a mesh in patches: connected, and facing about the same way. GAEA, section 2.2.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "core/base/watch.h"
#include "core/simplify/codebook.h"
#include "core/simplify/collapse_mesh.h"

namespace coppice {

class NormalPatches {
  public:
    // Of the live triangles, as they are now. Keeps a reference to the mesh.
    NormalPatches(const CollapseMesh& mesh, const Watch& watch);

    // Triangles whose normals have the same nearest code-vector, as far as edges connect them; those without
    // area go with a neighbour. Then, so often, the mean normal of each patch takes the place of its
    // code-vector, a triangle goes to the neighbouring patch whose one is nearest, and what still is
    // connected is a patch.
    void group(const Codebook& codebook, uint32_t refinements, const Watch& watch);

    // Whether all triangles at a live vertex have the same nearest code-vector.
    bool is_inside(uint32_t vertex, const Codebook& codebook) const;

    // After group(): of a live triangle; numbers without gaps.
    uint32_t patch(uint32_t triangle) const { return patches_[triangle]; }
    uint32_t patch_count() const { return patch_count_; }
    // The patch of all triangles at a vertex; no_index where there are two.
    uint32_t patch_around(uint32_t vertex) const;

  private:
    void connect(const Watch& watch);
    void quantize(const Codebook& codebook, const Watch& watch);
    void spread_labels();
    void split_into_components(const Watch& watch);
    bool move_to_nearer_means(const Watch& watch);

    const CollapseMesh& mesh_;
    std::vector<Vec3f> normals_;        // per triangle; unit, zero without area
    std::vector<uint32_t> neighbours_;  // per corner: the triangle across the edge to the next one, no_index
                                        // where there is none, or several
    std::vector<uint32_t> patches_;     // per triangle; code-vectors at first
    std::vector<uint32_t> parents_;     // scratch: per triangle, union-find
    uint32_t patch_count_ = 0;
};

}  // namespace coppice
