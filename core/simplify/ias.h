// ias: T. Azim, E. Cheslack-Postava, P. Levis, "Instance-aware simplification of 3D polygonal meshes", IEEE
// ICME 2015, as its author's code in Sirikata does it; of the paper only the abstract could be had.
//
// Idea: quadrics over all the instances of a mesh, but each mesh simplified once, and one queue over all
// meshes of the scene: the next edge is the one that costs the scene least. A mesh that stands large or often
// keeps more. The instances stay as they are, so the file only gets smaller; unless prune_instances lets go
// of some of what stands very often, where collapses end short of the target (instance_pruning.h).
//
// Guarantees: those of quadric (garland_heckbert.h). Complexity: O(F log F) for the F triangles of all unique
// meshes together, whatever the number of instances (instance_weights.h).
//
// Departures:
//   - The author's code transforms each triangle's plane for each instance: O(F N). Here the sum over
//   instances is one number for each triangle.
//   - Its target is a fixed fifth of the scene's triangles; here it is ratio or triangles.
//   - The rules of quadric; the code has no test for flips, and leaves attributes of the vertex that stays.
//   - A target in stored triangles counts a mesh once; ratio counts what the scene draws, as the code does.
#pragma once

#include "core/simplify/algorithm.h"

namespace coppice {

Algorithm ias();

}  // namespace coppice
