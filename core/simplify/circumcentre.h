// The point with the same distance to the three corners of a triangle.
#pragma once

#include <array>

#include "core/mesh/vec.h"

namespace coppice {

enum class Circumcentre {
    clamp,  // the nearest point of the triangle: of an obtuse one the midpoint of its longest edge
    paper,  // as printed, which is outside of an obtuse triangle, and farther the flatter it is
};

struct WeighedPoint {
    Vec3d point;
    std::array<double, 3> weights = {};  // of the corners; >= 0, summing to 1
};

// Li and Kim 2020 solve four planes for it; the closed form is the same point. A triangle without area gives
// the midpoint of its longest edge. The weights are barycentric; where the point is outside, of the nearest
// point of the triangle.
WeighedPoint circumcentre(Vec3d a, Vec3d b, Vec3d c, Circumcentre mode);

}  // namespace coppice
