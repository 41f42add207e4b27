// quadric: M. Garland, P. S. Heckbert, "Surface simplification using quadric error metrics", SIGGRAPH 1997.
//
// Idea: each vertex stands for the planes of the triangles that were merged into it; the sum of squared
// distances to them is one symmetric 4x4 matrix, the quadric. Take the edge whose best point has the least
// such sum, merge it there, add the quadrics, and go on.
//
// Guarantees: no new non-manifold edge, no flipped triangle (collapse_rules.h), none in the texture either
// (uv_guard.h), borders, UV seams and borders between materials stay within 5 % of the mesh's diagonal
// (line_guard.h), the bounding box moves by less than 1 % of it on each side. The reported error is an
// estimate (deviation.h), not a bound. Attributes are interpolated on the surface as it was (projection.h).
//
// Complexity: O(F log F) time for F triangles of bounded valence, about 300 bytes per triangle and 40 more
// with normals and UVs.
//
// Departures from the paper, and why:
//   - The rules above; the paper only penalises flips and knows no attributes, so the surface folds and
//   textures tear.
//   - weighting=area, the default, weighs planes by their triangles' area, which makes the result independent
//   of the tessellation (the authors' own later choice, 1998). none is the paper's.
//   - Planes across borders weigh boundary_weight times the edge's squared length, as the paper proposes
//   without a number.
//   - Only edges are pairs by default, as with the paper's t = 0. With a pair_distance, vertices of open
//   borders are pairs, too (vertex_pairs.h), and of those the ones whose merging gives no edge a third
//   triangle and agrees with all values but normals and colours (edge_collapse.h). So closed parts are not
//   joined: the paper lets them, and gets edges of four triangles.
//   - On flat ground, where all costs are 0, short edges go first.
#pragma once

#include "core/simplify/algorithm.h"

namespace coppice {

Algorithm quadric();

}  // namespace coppice
