// Which wedge of the vertex that stays takes the place of each wedge of the vertex that goes.
#pragma once

#include <cstdint>
#include <vector>

#include "core/simplify/attribute_cloud.h"
#include "core/simplify/collapse_mesh.h"
#include "core/simplify/wedge_values.h"

namespace coppice {

// Along the edge two triangles (or one, or more) hold both vertices: their corners pair the wedges. A wedge
// without such a triangle goes with another one of its chart to that one's chart, to the wedge there whose
// attributes are nearest (so hard edges in the shading merge at their cost, as "more than one pair of
// attributes were merged" in the ITS paper). Where a chart has no counterpart, or two, a seam would be
// crossed or torn, and there is no map.
class WedgeMap {
  public:
    WedgeMap(const CollapseMesh& mesh, const AttributeClouds& clouds) : mesh_(mesh), clouds_(clouds) {}

    // False when there is no map. `removed` and `kept` share at least one triangle.
    bool find(uint32_t removed, uint32_t kept);

    // The same for vertices without a triangle in common: each wedge goes to the one of its slot that could
    // be of its chart by the values that both have now. Of several, to that whose attributes are nearest.
    bool find_across(uint32_t removed, uint32_t kept, const WedgeValues& values);

    // After find: per wedge of `removed`, in order; no_index for wedges that no corner uses and no chart
    // leads on.
    const std::vector<uint32_t>& wedges() const { return map_; }

  private:
    bool pair_along_edge(uint32_t removed, uint32_t kept);
    bool pair(uint32_t from, uint32_t to);
    bool follow_charts();
    uint32_t chart_counterpart(uint32_t wedge) const;
    uint32_t nearest(uint32_t from, uint32_t near_wedge) const;

    const CollapseMesh& mesh_;
    const AttributeClouds& clouds_;
    std::vector<uint32_t> map_;
    std::vector<bool> used_;  // by a corner
    uint32_t first_ = 0;      // wedge of `removed`
};

}  // namespace coppice
