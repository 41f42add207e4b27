// Surface angle. H. Li, S. Kim, A novel mesh simplification method based on vertex removal using surface
// angle, IJERT 2019.
//
// Idea: a vertex where all included angles between its triangles (180 degrees less the angle of their
// normals, eq. 2) are larger than a threshold adds little to the shape. It is removed and the hole is filled
// again. Vertices are taken by number, and those around a removed one are kept: their triangles were not
// what the angles were measured on (the paper does not say; its counts need it).
//
// Default (stitch=delaunay): holes are filled by ears on the plane that fits them, then edges are flipped
// (hole_triangulation.h, delaunay_flips.h). One round where the angle is given alone; where there is a
// target, rounds at the largest angles that meet it (angle_removal.h). Guarantees: those of
// vertex_removal.h: no new non-manifold edge, no flipped, degenerate or duplicate triangle; no vertex moves,
// and no value of one changes; borders and seams stay, or with borders=remove lose vertices where they are as
// straight, within a tolerance. Creases run on, and corners stay longer than the creases that meet there.
//
// stitch=paper: as printed, and then without any guard of the surface. The vertices around the hole are
// sorted by x, y and z and joined to the largest in that order (section III.C), which is not the order in
// which they lie there: triangles overlap, and there are n - 1 of them where a hole of n vertices has room
// for n - 2. stitch=zigzag: the strip that the paper draws in the plane (figure 3, left), guarded.
//
// The paper's model, a monkey's head, has 507 vertices and 968 triangles, a third of what it prints of each:
// most likely it prints lengths of arrays of three numbers. A third of its triangle counts is what we leave,
// within seven (bench/papers prints its Table 1 beside ours), when vertices are numbered as their file has
// them. With its stitch a vertex on a border leaves as many triangles as it had; one with a single triangle
// stays.
//
// Complexity: O(F log F) time, about 200 bytes per triangle.
#pragma once

#include "core/simplify/algorithm.h"

namespace coppice {

Algorithm surface_angle();

}  // namespace coppice
