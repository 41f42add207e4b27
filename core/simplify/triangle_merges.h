// What vt, ivdd and vtd have in common: they look at one triangle after another and merge two or three of its
// corners.
#pragma once

#include <array>
#include <cstdint>
#include <optional>

#include "core/simplify/circumcentre.h"
#include "core/simplify/cluster_rounds.h"

namespace coppice {

// Which corners to merge at a threshold, as bits 1, 2, 4; 0: none. edges: lengths of 01, 12, 20. Where it
// runs guarded it takes all three or the ends of the shortest edge, and none where that is longer.
using TriangleDecision = uint32_t (*)(const std::array<double, 3>& edges, double threshold);

struct TriangleMerges {
    TriangleDecision decide = nullptr;
    Circumcentre circumcentre = Circumcentre::clamp;  // where three corners go; two go to their midpoint
    // As printed: triangles in the order of the mesh, no guards (vertex_clusters.h). Else shorter ones first,
    // under the rules of star_contraction.h.
    bool as_printed = false;
    // As printed only. Triangles see vertices that were merged before, and merge them again; else a vertex is
    // merged once in a round.
    bool sequential = false;
};

// Nothing happens to a mesh that is small enough.
Simplified simplify_by_triangles(const Mesh& source, const Target& target, const TriangleMerges& merges,
                                 const RoundOptions& options, const Watch& watch);

}  // namespace coppice
