// ITS: instanced textured simplification. S. Tariq, A. U. Rahman, T. Azim, R. G. Khan, "Instanced model
// simplification using combined geometric and appearance-related metric", arXiv 2101.02570.
//
// Idea: simplify each unique mesh once, for all its instances; collapse the edge with the least unified error
// of geometry, normals, UVs and colours (unified_error.h) onto the end where that error is smaller. As
// positions and wedges of the result are some of the input's, every instance, skin, morph target and custom
// attribute stays valid.
//
// mode=full (default) ranks all edges. mode=faithful ranks by error only the pairs that the paper's threshold
// t leaves: edges shorter than t, where t doubles while there is none and halves while there are more than
// ten. In effect that collapses about the shortest edges first and is there for reproduction.
//
// Guarantees, in both modes: no new non-manifold edge, no flipped triangle (collapse_rules.h), none in the
// texture either (uv_guard.h), borders, UV seams and borders between materials stay (vertex_kind.h,
// wedge_map.h) within 5 % of the mesh's diagonal (line_guard.h), the bounding box shrinks by less than 1 % of
// it on each side. The reported error is an estimate (deviation.h), not a bound.
//
// Complexity: O(F log F) time for F triangles of bounded valence, about 300 bytes per triangle with normals
// and UVs. Vertices of more than 128 triangles stay.
//
// Departures from the paper, and why. In both modes:
//   - The rules above, which the paper does not have and without which the surface folds.
//   - A pair is an edge. The paper says "edge or distance < t", then "edge and distance < t"; what it says of
//     thresholds fits the second. "Valid pairs < 0" is read as "= 0".
//   - The paper interpolates attributes at the merged vertex, although that is always an old one, where
//     interpolation gives the vertex' own values: these are taken as they are.
// full:
//   - Quadrics weighted by area and Gamma = sqrt(Q / area), so that Gamma is a length like the attribute
//   errors.
//   - Planes that hold borders and seams; short edges first on flat ground.
//   - Geometric errors are those of the mean instance (instance_metric.h): where instances stretch the mesh,
//     more is kept of what they enlarge. The paper's instances only copy.
// faithful: quadrics as printed, unweighted, but
//   - Gamma = sqrt(Q / number of planes), for its unit.
//   - Where t has more than ten pairs and t/2 none, the ten shortest are taken: t would swing for ever.
//   - Where the pairs under t are all refused, the next longer ones are taken.
//   - Its error does not see borders, so a vertex where one turns by more than 60 degrees stays.
#pragma once

#include "core/simplify/algorithm.h"

namespace coppice {

Algorithm its();

}  // namespace coppice
