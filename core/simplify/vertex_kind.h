// What the surface is like at each vertex, and which collapses that forbids. Collapsed edges leave it so;
// where parts are joined it is found anew (vertex_classifier.h). Triangles on the same three vertices
// (decals, sheets back to back) count as one surface of several layers.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "core/base/watch.h"
#include "core/simplify/collapse_mesh.h"

namespace coppice {

// Of the angle between the triangles at an edge: 30 degrees from flat. What is sharper is a crease.
inline constexpr double crease_cosine = 0.866025404;

enum class VertexKind : uint8_t {
    manifold,  // a disc inside one chart
    border,    // on one open border, off seams
    seam,      // on one seam: UVs, slots or other protected attributes break along two edges
    corner,    // borders and seams meet or end here; it stays
    complex,   // an edge where more than two sides meet, or several fans
};

inline constexpr size_t vertex_kinds = 5;

// may_collapse[removed][kept]. A line (border, seam) shortens along itself only, so it may end in a corner;
// the edge must also be of the line, see edge_allows. Nothing else moves a corner.
inline constexpr std::array<std::array<bool, vertex_kinds>, vertex_kinds> may_collapse = {{
    //  manifold border seam  corner complex
    {{true, true, true, true, true}},       // manifold
    {{false, true, false, true, true}},     // border
    {{false, false, true, true, true}},     // seam
    {{false, false, false, false, false}},  // corner
    {{false, false, false, true, true}},    // complex
}};

inline bool allows(VertexKind removed, VertexKind kept) {
    return may_collapse[static_cast<size_t>(removed)][static_cast<size_t>(kept)];
}

// An edge of a border or a seam, with one triangle at it. Seams are listed once per side.
struct FeatureEdge {
    uint32_t a = 0, b = 0;
    uint32_t triangle = 0;
    bool is_border = false;
};

struct Features {
    std::vector<VertexKind> kinds;  // per vertex
    std::vector<FeatureEdge> edges;
};

// Makes corners of the vertices where a border turns by more than 60 degrees. For orders of collapses whose
// error does not see borders.
void lock_sharp_borders(const CollapseMesh& mesh, Features& features);

// Makes corners of all vertices of borders.
void lock_borders(Features& features);

// O(triangles). Throws when the watch is stopped.
Features find_features(const CollapseMesh& mesh, const Watch& watch);

}  // namespace coppice
