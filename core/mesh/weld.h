// Merging what is bit-equal, dropping what is unused. All throw when the watch is stopped, and leave a mesh
// that is good for nothing.
#pragma once

#include "core/base/watch.h"
#include "core/mesh/mesh.h"

namespace coppice {

// Merges vertices with equal positions (-0 equals +0) and then wedges of the same vertex whose attributes,
// morph deltas and slots' attribute sets are equal. Readers call it once, with a vertex per wedge. Order of
// first use is kept, so the result does not depend on anything but the input. Unused vertices and wedges
// stay. O(wedges).
void weld(Mesh& mesh, const Watch& watch = {});

// Drops wedges that no triangle uses and vertices that no wedge uses; order is kept.
void drop_unused(Mesh& mesh, const Watch& watch = {});

struct CleanedTriangles {
    size_t degenerate = 0;  // two corners at one vertex, or zero area that no morph target opens
    size_t duplicate = 0;   // the same slot and three wedges in the same winding, kept once
};

// Removes degenerate and duplicate triangles (first occurrence stays). Of a welded mesh: triangles that lie
// on each other with other materials or attributes (a decal) are none.
CleanedTriangles drop_degenerate_and_duplicate(Mesh& mesh, const Watch& watch = {});

}  // namespace coppice
