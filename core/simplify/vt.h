// VT: vertex triplex. H. Li, S. Kim, Mesh simplification algorithms for rendering performance, IJERT 2020.
//
// Idea: a triangle's three vertices are merged at the centre of its circumcircle. "Each triangle", as the
// paper says, would give more points than there were; so a triangle is merged where none of its vertices was
// in this round.
//
// Default (circumcenter=clamp): small triangles first, in rounds until the target is met, each only as far as
// it takes (cluster_rounds.h); the centre of an obtuse triangle is the midpoint of its longest edge, as the
// real one lies outside, without bound. Guarantees: those of star_contraction.h: no new non-manifold edge, no
// flipped, degenerate or duplicate triangle; borders, seams and the box stay. Attributes are interpolated at
// the centre. circumcenter=paper: in the order of the mesh, unguarded, one round unless `passes` or the
// target ask for more; surfaces may fold and close (vertex_clusters.h).
//
// "Retriangulation" is Delaunay flips of edges (delaunay_flips.h): a Delaunay triangulation of points in
// space would be tetrahedra. Complexity: O(F log F) time, about 200 bytes per triangle.
#pragma once

#include "core/simplify/algorithm.h"

namespace coppice {

Algorithm vt();

}  // namespace coppice
