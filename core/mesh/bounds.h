// Axis-aligned boxes.
#pragma once

#include <limits>
#include <span>

#include "core/mesh/vec.h"

namespace coppice {

// Empty until extended: then min > max, diagonal() is 0.
struct Bounds {
    Vec3d min = {std::numeric_limits<double>::infinity(), std::numeric_limits<double>::infinity(),
                 std::numeric_limits<double>::infinity()};
    Vec3d max = {-std::numeric_limits<double>::infinity(), -std::numeric_limits<double>::infinity(),
                 -std::numeric_limits<double>::infinity()};

    bool empty() const { return min.x > max.x; }
    double diagonal() const { return empty() ? 0 : length(max - min); }
    void extend(Vec3d point);
    void extend(const Bounds& other);
};

Bounds bounds(std::span<const Vec3f> positions);

}  // namespace coppice
