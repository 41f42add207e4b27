// SS: spherical scanning. H. Li, S. Kim, Mesh simplification algorithms for rendering performance, IJERT
// 2020.
//
// Idea: a ball of radius r goes from vertex to vertex; all vertices in it that are left are merged. "Multiple
// methods are combined" for the new vertex: here the best of the ball's centre, the mean of its vertices and
// the point of least quadric error, if that is in the ball, by the sum of the vertices' quadrics.
//
// Default (neighborhood=connected): only vertices that edges inside the ball connect to its centre, where the
// surface faces within 90 degrees of it: the paper's own complaint is that tips and thin parts fuse. r is
// found by search where there is a target (threshold_search.h), and is the smallest that meets it; further
// rounds finish what was refused (cluster_rounds.h). Guarantees: those of star_contraction.h: no new
// non-manifold edge, no flipped, degenerate or duplicate triangle; borders, seams and the box stay. A set
// that is refused is tried again without its later half. A vertex moves by at most 2 r in a round.
// Attributes: the centre's, the mean, or weighed by 1 / distance^2, as the point is chosen.
// neighborhood=euclidean: whatever is in the ball, unguarded, as printed (vertex_clusters.h); the mean.
//
// "Retriangulation" is Delaunay flips (delaunay_flips.h). Complexity: O(F log F) time while balls hold few
// vertices, about 250 bytes per triangle.
#pragma once

#include "core/simplify/algorithm.h"
#include "core/simplify/cluster_rounds.h"

namespace coppice {

Algorithm ss();

enum class Neighborhood { connected, euclidean };
Neighborhood neighborhood_in(const ParameterValues& values);

// For algorithms that end with it: over all that is larger than the target. radius in mesh units.
Simplified scan_spheres(const Mesh& source, const Target& target, Neighborhood neighborhood,
                        const RoundOptions& radius_and_rounds, const Watch& watch);

}  // namespace coppice
