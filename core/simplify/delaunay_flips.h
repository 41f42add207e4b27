// Edges turned until the triangles on both sides are as equiangular as they get: what Li and Kim call
// Delaunay retriangulation, on a surface.
#pragma once

#include <cstdint>
#include <functional>

#include "core/base/watch.h"
#include "core/simplify/collapse_mesh.h"
#include "core/simplify/uv_guard.h"

namespace coppice {

// Whether the edge between two triangles may be flipped; each keeps its number.
using MayFlip = std::function<bool(uint32_t triangle, uint32_t other)>;

// Flips every edge whose opposite angles sum to more than 180 degrees (Lawson 1977), one after another, until
// there is none, or twenty times as many were looked at as there are edges. Only inside a chart, where
// exactly two triangles meet, less than 30 degrees from flat, and none is turned over, in space or in a
// texture. Keeps all counts. Returns the flips. O(triangles) in practice.
uint64_t delaunay_flips(CollapseMesh& mesh, const UvGuard& uvs, const Watch& watch,
                        const MayFlip& may_flip = {});

}  // namespace coppice
