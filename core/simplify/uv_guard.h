// Keeps texture maps from folding: no triangle is wound the other way than before in the plane of a UV set.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "core/base/watch.h"
#include "core/mesh/mesh.h"
#include "core/simplify/collapse_mesh.h"

namespace coppice {

// A triangle can face the right way in space while its texture is mirrored or shrunk to a line: at the axis
// of a mirrored map, or where a chart is not convex. So it keeps its winding. One without area in a plane at
// the start (one colour of a palette, say) may stay so or get any; but no triangle may be wound against its
// corners, where all was wound alike at the start: a small fold would grow into the texture around it.
class UvGuard {
  public:
    UvGuard(const CollapseMesh& mesh, const Mesh& source, const Watch& watch);

    // Whether every triangle that moves keeps its winding, in each set of UVs. wedge_map as WedgeMap gives it
    // for the pair.
    bool may_collapse(uint32_t removed, uint32_t kept, const std::vector<uint32_t>& wedge_map) const;

  private:
    struct Uv {
        float u = 0, v = 0;
    };
    void add_set(const CollapseMesh& mesh, const Attribute& uvs, uint32_t set, const Watch& watch);
    using Wedges = std::array<uint32_t, 3>;  // of a triangle's corners
    bool keeps_winding(const Wedges& before, const Wedges& after, uint32_t set) const;
    int8_t winding(const Wedges& wedges, uint32_t set) const;  // 1 or -1, 0 without area
    const Uv& uv(uint32_t wedge, uint32_t set) const { return uvs_[size_t{wedge} * sets_ + set]; }

    const CollapseMesh& mesh_;
    uint32_t sets_ = 0;
    std::vector<Uv> uvs_;  // per wedge and set
    std::vector<int8_t>
        around_;  // per chart and set: winding of all its triangles at the start, 0 where they disagree
};

}  // namespace coppice
