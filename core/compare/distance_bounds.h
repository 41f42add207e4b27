// Between which two numbers the largest distance from one surface to another lies, for certain.
#pragma once

#include "core/compare/bvh.h"

namespace coppice {

struct DistanceBounds {
    double lower = 0;  // there is a point as far away as this
    double upper = 0;  // and none farther
};

// One direction: max over points of `from` of the distance to the nearest point of `to`, to within
// `tolerance` (model units, over 0). The distance to one triangle is convex, so over a triangle it is largest
// at a corner: with every triangle u of `to`, max over the corners c of d(c, u) bounds the distance of all
// points of a triangle. Of u the nearest ones of corners and centroid are tried, and triangles whose bound is
// more than the tolerance above what is known to be reached are split into four. Certain but for rounding, of
// about 1e-15 of the coordinates.
//
// For a guarantee of `limit` ask for 1 % of it. Both surfaces have triangles. The work grows with the area on
// which the distance is within a few tolerances of the largest; memory does not grow at all. The same bounds
// for any number of threads; stops within 50 ms.
DistanceBounds distance_bounds(const Surface& from, const Bvh& to, double tolerance, unsigned threads,
                               const Watch& watch);

}  // namespace coppice
