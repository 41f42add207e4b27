// GAEA: patches of quantized normals. G. Subramaniam, K. Ong, Mesh simplification using ellipsoidal schema
// for isotropic quantization of face-normal vectors, APVIS 2006.
//
// Idea: normals are quantized to a codebook (codebook.h); connected triangles of one code-vector are a patch,
// almost flat (normal_patches.h); the vertices inside patches are collapsed into those at their edges, the
// shortest edge first (patch_collapse.h). More goes with fewer code-vectors, and with more passes.
//
// A threshold alone (n, xyz, codebook_size): one pass with that codebook, or with iterate=true the paper's
// iterations from there. With a target, each pass has the finest codebook whose patches hold as many vertices
// as are to go (threshold_search.h), unless iterate=true asks for the paper's; while there is none, 5-5-5
// takes what it can, as in the paper's iterations. threshold_used is the smallest n, or the fewest
// code-vectors.
//
// Guarantees: those of quadric.h with placement=endpoint: no new non-manifold edge, no flipped, degenerate or
// duplicate triangle, borders, seams and the box stay. Positions and attributes are some of the mesh's,
// untouched; vertices at the edges of patches stay.
//
// Departures from the paper, and why:
//   - The rules above. The paper has none, and a patch of 6 code-vectors can fold.
//   - Its neighbour region asks for the nearest code-vector and for the least angle, with a cosine where the
//     angle must be meant; for unit vectors these are one condition.
//   - It refines the codebook once, with the mean normals of patches; refine=2, the default, fits its counts
//     better (docs/results.md).
//   - Its "pre-determined filter" from the bounding box to x, y and z is not told; here they are in
//     proportion to the box's edges.
//   - Iterations go to a smaller codebook where a pass takes less than 0.2 % of the triangles; the paper's
//     go on until it takes none.
//   - remesh=triangulate is one of the "other polygon triangulation algorithms" that it allows: Delaunay
//     flips inside patches between collapses.
//
// Complexity: O(F log F) time for F triangles, about 250 bytes per triangle.
#pragma once

#include "core/simplify/algorithm.h"

namespace coppice {

Algorithm gaea();

}  // namespace coppice
