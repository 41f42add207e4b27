// The point of a triangle that is nearest to another point.
#pragma once

#include <array>

#include "core/mesh/vec.h"

namespace coppice {

struct TrianglePoint {
    std::array<double, 3> weights = {1, 0, 0};  // barycentric, of the three corners; not negative, sum 1
    double squared_distance = 0;
};

// Edges and corners included; of a triangle without area (to rounding) the nearest point of its edges.
// Ericson, Real-Time Collision Detection, 5.1.5.
TrianglePoint closest_point(Vec3d p, Vec3d a, Vec3d b, Vec3d c);

inline Vec3d interpolate(const std::array<double, 3>& weights, Vec3d a, Vec3d b, Vec3d c) {
    return a * weights[0] + b * weights[1] + c * weights[2];
}

}  // namespace coppice
