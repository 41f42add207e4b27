// VTD: vertex triplex distance. H. Li, S. Kim, Mesh simplification algorithms for rendering performance,
// IJERT 2020.
//
// Idea: vt and ivdd in one. A triangle whose three edges are shorter than a threshold T merges at its
// circumcentre; one with fewer loses an edge, to its midpoint.
//
// Which edge: the paper takes the first edge of at most T, compares the other two, and merges the ends of the
// longer of these, which may exceed T. That looks like an error, or removes slivers without saying so.
// rule=short (default) merges the shortest edge; rule=paper does as printed, but no pair farther apart than
// 2 T.
//
// Default (rule=short, circumcenter=clamp): like ivdd, a vertex is merged once in a round; T is found by
// search where there is a target (threshold_search.h), further rounds follow where no T meets it
// (cluster_rounds.h). Guarantees: those of star_contraction.h: no new non-manifold edge, no flipped,
// degenerate or duplicate triangle; borders, seams and the box stay. Attributes are interpolated where the
// vertices merge. With either set to paper it runs in the order of the mesh and unguarded
// (vertex_clusters.h).
//
// "Retriangulation" is Delaunay flips (delaunay_flips.h). Complexity: O(F log F) time, about 200 bytes per
// triangle.
#pragma once

#include "core/simplify/algorithm.h"

namespace coppice {

Algorithm vtd();

}  // namespace coppice
