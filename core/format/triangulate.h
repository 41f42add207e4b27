// Polygons into triangles.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "core/mesh/vec.h"

namespace coppice {

// Appends corners.size() - 2 triangles, each three indices into corners, with the polygon's winding. A quad
// is split along its shorter inner diagonal; larger ones are clipped ear by ear on the plane of their Newell
// normal, so concave and keyhole polygons come out right. Degenerate polygons give degenerate triangles.
// corners.size() >= 3. Time: n * (concave corners), bounded by a few thousand tests a corner; what is left
// beyond that becomes a fan.
void triangulate(std::span<const Vec3d> corners, std::vector<uint32_t>& triangles);

}  // namespace coppice
