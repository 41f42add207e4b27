// The project's own algorithm: quadrics over geometry, normals, texture coordinates and colours, in passes
// over packed arrays (packed_collapse.h); what those do not treat, the shared machinery does edge by edge
// (edge_collapse.h).
//
// Guarantees: those of both: no new non-manifold edge, no turned, degenerate or duplicate triangle, borders,
// seams and the box stay within their tolerances, deterministic. Complexity: O(n) for each pass over what is
// left, and each takes a good part of it; O(n log n) for the rest. Of flat-shaded meshes, at whose every
// vertex several sets of normals meet, all is rest: there the unified error of GAPS decides, and the weights
// of attributes and instances do not count.
#pragma once

#include "core/simplify/algorithm.h"

namespace coppice {

Algorithm attribute_quadric();

}  // namespace coppice
