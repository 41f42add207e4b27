// Vertex attributes as glTF demands them: unit normals, tangents with a sign, weights that sum to one.
#pragma once

#include "core/base/watch.h"
#include "core/mesh/mesh.h"

namespace coppice::gltf {

// Values that are legal already keep their bits. Normals without a direction take that of their triangles.
// Called on what is read (a lossy stream may be a little off) and before writing (simplification makes new
// values).
void make_legal(Mesh& mesh, const Watch& watch);

}  // namespace coppice::gltf
