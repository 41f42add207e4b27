// Merging what is bit-equal, dropping what is unused.
#pragma once

#include "core/mesh/mesh.h"

namespace coppice {

// Merges vertices with equal positions (-0 equals +0) and then wedges of the same vertex whose attributes,
// morph deltas and slots' attribute sets are equal. Readers call it once, with a vertex per wedge. Order of
// first use is kept, so the result does not depend on anything but the input. Unused vertices and wedges
// stay. O(wedges).
void weld(Mesh& mesh);

// Drops wedges that no triangle uses and vertices that no wedge uses; order is kept.
void drop_unused(Mesh& mesh);

struct CleanedTriangles {
    size_t degenerate = 0;  // two corners at one vertex, or zero area
    size_t duplicate = 0;   // the same three vertices in the same winding, kept once
};

// Removes degenerate and duplicate triangles (first occurrence stays).
CleanedTriangles drop_degenerate_and_duplicate(Mesh& mesh);

}  // namespace coppice
