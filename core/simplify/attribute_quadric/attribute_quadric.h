// The project's own algorithm: quadrics over geometry, normals, texture coordinates and colours, in passes
// over packed arrays (packed_collapse.h); what those do not treat, the shared machinery does edge by edge
// (edge_collapse.h).
//
// Guarantees: those of both: no new non-manifold edge, no turned, degenerate or duplicate triangle, borders,
// seams and the box stay within their tolerances, deterministic. Complexity: O(n) for each of about ten
// passes over what is left, O(n log n) for the rest.
#pragma once

#include "core/simplify/algorithm.h"

namespace coppice {

Algorithm attribute_quadric();

}  // namespace coppice
