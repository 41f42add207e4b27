// On which side a point lies, without rounding: the sign is that of the real numbers.
#pragma once

#include "core/mesh/vec.h"

namespace coppice {

// The sign of the volume of the tetrahedron: 1 where d lies below the plane in which a, b, c are
// counter-clockwise seen from above, -1 above, 0 in it. A filter decides nearly always, else the 48 products
// are summed up exactly (expansions: Shewchuk 1997).
int orientation(Vec3f a, Vec3f b, Vec3f c, Vec3f d);

// The same in a plane, of (x, y): 1 where a, b, c are counter-clockwise.
struct Point2f {
    float x = 0, y = 0;

    friend bool operator==(const Point2f&, const Point2f&) = default;
};
int orientation(Point2f a, Point2f b, Point2f c);

}  // namespace coppice
