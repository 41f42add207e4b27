// IVDD: intervertex distance dependence. H. Li, S. Kim, Mesh simplification algorithms for rendering
// performance, IJERT 2020.
//
// Idea: of each triangle, vertices nearer than a threshold T are merged: all three at the circumcentre where
// two or three edges are shorter, the two of one short edge at its midpoint.
//
// Default (mode=once, circumcenter=clamp): a vertex is merged once in a round, so it moves by less than T
// there; triangles with short edges first; T is found by search where there is a target
// (threshold_search.h), and is the smallest that meets it; where none does, further rounds follow
// (cluster_rounds.h). Guarantees: those of star_contraction.h: no new non-manifold edge, no flipped,
// degenerate or duplicate triangle; borders, seams and the box stay. Attributes are interpolated where the
// vertices merge. As printed, in the order of the mesh and unguarded (vertex_clusters.h), it runs with
// circumcenter=paper, and with mode=sequential, where triangles see the vertices merged before and merge them
// again: such clusters drift without bound.
//
// "Retriangulation" is Delaunay flips (delaunay_flips.h). Complexity: O(F log F) time, about 200 bytes per
// triangle.
#pragma once

#include "core/simplify/algorithm.h"

namespace coppice {

Algorithm ivdd();

}  // namespace coppice
