// What a mesh is made of, and what is wrong with it.
#pragma once

#include <cstdint>
#include <limits>

#include "core/base/watch.h"
#include "core/mesh/mesh.h"

namespace coppice {

// Counts add up over meshes; all lengths, areas and volumes are in the mesh's own frame.
struct Elements {
    uint64_t triangles = 0;
    uint64_t vertices = 0;              // positions that a triangle uses
    uint64_t degenerate_triangles = 0;  // two corners at one position, or no area
    uint64_t duplicate_triangles = 0;   // the same three vertices in the same winding as an earlier one
    uint64_t non_manifold_edges = 0;    // of more than two triangles
    uint64_t inconsistent_edges = 0;    // of two triangles that run along it in the same direction
    uint64_t border_edges = 0;          // of one triangle
    double border_length = 0;
    uint64_t components = 0;   // of triangles that share vertices
    int64_t euler_number = 0;  // vertices - edges + triangles: 2 for each closed surface without handles
    double area = 0;
    double volume = 0;            // signed; only of closed surfaces does it not depend on the origin
    double smallest_angle = 180;  // degrees, over the triangles that are not degenerate

    void add(const Elements& other);
};

// Of a mesh whose equal positions are one vertex. O(n log n).
Elements count_elements(const Mesh& mesh, const Watch& watch);

}  // namespace coppice
