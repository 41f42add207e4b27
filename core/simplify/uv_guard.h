// Keeps texture maps from folding: no triangle is wound the other way than before in the plane of a UV set.
#pragma once

#include <array>
#include <cstdint>
#include <span>
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

    bool any() const { return sets_ > 0; }  // else all is allowed
    // The same for one triangle whose corner gets a blend of wedges.
    bool may_blend(uint32_t corner, std::span<const WedgeShare> shares) const;
    // Whether a triangle of these wedges, each of its own chart, is wound as all was around them.
    bool is_wound_well(const std::array<uint32_t, 3>& wedges) const;
    // To be called where WedgeValues::blend is.
    void blend(std::span<const WedgeShare> shares, uint32_t into);

  private:
    struct Uv {
        float u = 0, v = 0;
    };
    using Uvs = std::array<Uv, 3>;  // of a triangle's corners
    void add_set(const CollapseMesh& mesh, const Attribute& uvs, uint32_t set, const Watch& watch);
    using Wedges = std::array<uint32_t, 3>;  // of a triangle's corners
    bool keeps_winding(int8_t was, int8_t is, const Wedges& charts_of, uint32_t set) const;
    Uvs uvs_of(const Wedges& wedges, uint32_t set) const;
    Uv blended(std::span<const WedgeShare> shares, uint32_t set) const;
    const Uv& uv(uint32_t wedge, uint32_t set) const { return uvs_[size_t{wedge} * sets_ + set]; }

    const CollapseMesh& mesh_;
    uint32_t sets_ = 0;
    std::vector<Uv> uvs_;  // per wedge and set
    std::vector<int8_t>
        around_;  // per chart and set: winding of all its triangles at the start, 0 where they disagree
};

}  // namespace coppice
