// Machine parts. All are closed, with sharp edges kept sharp in their normals and a chart per face.
#pragma once

#include <cstdint>

#include "core/mesh/mesh.h"

namespace coppice {

// About `triangles` triangles each; the one slot has the given material. Lengths are in centimetres or so.
Mesh bolt_mesh(uint32_t triangles, uint32_t material);  // hexagonal head, threaded shank along z, head on top
Mesh plate_mesh(uint32_t triangles, uint32_t material);  // 4 x 4 x 0.3, four holes at (+-1, +-1)
Mesh bracket_mesh(uint32_t triangles,
                  uint32_t material);  // an L whose one leg widens: differs from its mirror image

}  // namespace coppice
