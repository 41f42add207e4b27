// The unit of lengths that scale with a mesh.
#pragma once

#include "core/mesh/mesh.h"

namespace coppice {

// Mean length of the triangles' edges, mesh units; an edge counts once for each triangle. 0 without
// triangles.
double mean_edge(const Mesh& mesh);

}  // namespace coppice
