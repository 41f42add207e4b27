// Whether two triangles meet where they should not.
#pragma once

#include <array>

#include "core/mesh/vec.h"

namespace coppice {

using TriangleCorners = std::array<Vec3f, 3>;

// Whether three corners lie on a line. Exact.
bool is_flat(const TriangleCorners& t);

// Whether two triangles, neither of them flat, have a point in common besides the corners and the edge that
// they share (equal positions). Touching is meeting. Two that share all corners do not meet elsewhere. Exact:
// made of signs that have no rounding.
bool meet_elsewhere(const TriangleCorners& t, const TriangleCorners& u);

}  // namespace coppice
