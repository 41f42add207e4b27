// openmesh: the quadric decimater of OpenMesh (M. Botsch, S. Steinberg, S. Bischoff, L. Kobbelt, "OpenMesh: a
// generic and efficient polygon mesh data structure", OpenSG Symposium 2002), as a baseline.
//
// Idea: OpenMesh ranks half-edges by the quadric error of Garland and Heckbert at their end and collapses the
// least, on its half-edge mesh. What else must hold of the result, and what happens to attributes, is decided
// by the rules that all our algorithms have (edge_collapse.h).
//
// Guarantees: those of quadric with placement=endpoint. Complexity: O(F log F), about 350 bytes per triangle.
//
// What a half-edge mesh cannot hold (edges with more than two triangles, or two that run along them in the
// same direction, and vertices where several fans meet) stays as it is.
#pragma once

#include "core/simplify/algorithm.h"

namespace coppice {

Algorithm openmesh();

}  // namespace coppice
