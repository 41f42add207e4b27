// FAD: face angle dependency. H. Li, S. Kim, Mesh simplification algorithms for rendering performance, IJERT
// 2020.
//
// Idea: surface_angle.h with a second condition: a vertex is removed where all angles between its triangles
// are larger than a threshold and its triangles are not too large.
//
// The paper's text removes where the included angles are "less than the threshold", against its own figure,
// its hybrid FASS and the paper of 2019: it is read as the angle between normals. Its rule for the area is
// not given: area_limit is how much of the surface a vertex may have around it, in means over all vertices.
//
// Any two triangles of a vertex are compared (pairs=all). Rounds until nothing is left to remove at an angle
// that is given, or where there is a target, as many as it takes at the largest angles that meet it
// (angle_removal.h). A vertex takes two triangles with it; one of a border one: these, and seams, lose
// vertices where they are as straight as the surface has to be flat. Guarantees: those of vertex_removal.h:
// no new non-manifold edge, no flipped, degenerate or duplicate triangle; no vertex moves, and no value of
// one changes; borders and seams stay within a tolerance. "Retriangulation" is as in surface_angle.h.
//
// Complexity: O(F log F) time, about 200 bytes per triangle.
#pragma once

#include "core/simplify/algorithm.h"
#include "core/simplify/angle_removal.h"

namespace coppice {

Algorithm fad();

// For algorithms that begin with it.
Parameter area_limit_parameter();
AngleOptions angle_options_in(const ParameterValues& values);

}  // namespace coppice
