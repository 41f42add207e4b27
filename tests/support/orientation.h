// Whether triangles face the way the original does: in space, and in the plane of the texture coordinates.
#pragma once

#include <gtest/gtest.h>

#include "core/mesh/mesh.h"

namespace coppice::test {

// No triangle is turned away from the original surface. Four places vote, the corners and the centroid: each
// by the angle between the triangle's normal and that of the original's nearest point (the mean of the
// triangles there, weighted by their angles). A triangle and its mirror image get opposite votes, so that
// never both pass, but where the original has no outside: where it faces both ways at all four places (sheets
// back to back), and at corners of triangles that fail this themselves (flaps, inverted faces).
//
// accuracy, in mesh units: where the original also has a surface that is farther than the nearest by no more
// than that, the one that the triangle faces best counts. A branch that is thinner than the result is
// accurate has no sides.
::testing::AssertionResult has_no_flipped_triangle(const Mesh& before, const Mesh& after,
                                                   double accuracy = 0);

// No triangle has its first texture coordinates in the other winding than the original's triangles around its
// corners, or has no area there although they do. A corner votes when all the original's triangles that use
// its very wedge are wound alike: not where a texture is folded or without area. For algorithms that keep
// original wedges.
::testing::AssertionResult keeps_uv_orientation(const Mesh& before, const Mesh& after);

}  // namespace coppice::test
