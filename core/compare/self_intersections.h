// Where a mesh runs through itself.
#pragma once

#include <cstdint>

#include "core/compare/bvh.h"

namespace coppice {

struct SelfIntersections {
    uint64_t pairs = 0;      // of triangles that meet elsewhere than where they share corners
    uint64_t triangles = 0;  // that are in one of them
};

// Exact; see triangle_contact.h. Of a surface made of one mesh, whose coordinates are floats. Triangles
// without area are left out. O(n log n) where few boxes meet. Any number of threads.
SelfIntersections find_self_intersections(const Surface& surface, const Bvh& bvh, unsigned threads,
                                          const Watch& watch);

}  // namespace coppice
