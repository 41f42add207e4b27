// Triangles of a simplified surface that face the wrong way.
#pragma once

#include <cstdint>

#include "core/compare/deviation.h"

namespace coppice {

struct Flips {
    uint64_t triangles = 0;          // that face against the reference's surface
    uint64_t texture_triangles = 0;  // whose texture is mirrored where the reference's is not, or the reverse
};

// Looks at seven points of each of the candidate's triangles, the corners, the centroid and one between it
// and each corner, and at the reference's triangles there (those as near as the nearest one; of these the one
// that faces it best). A triangle is flipped where the cosines of the seven angles sum to less than 0, its
// texture where most of the points whose texture has an area say so. The corners are there since a triangle
// that cuts off the folds of a rough surface has any side of any fold beside it, while its corners are where
// it belongs. Triangles without area are not counted. Any number of threads.
Flips count_flips(const SearchedSurface& reference, const Surface& candidate, unsigned threads,
                  const Watch& watch);

}  // namespace coppice
