// Triangles as they are compared: one frame, one order.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "core/base/watch.h"
#include "core/mesh/bounds.h"
#include "core/mesh/mesh.h"
#include "core/scene/instance.h"
#include "core/scene/scene.h"

namespace coppice {

// About 90 bytes for each triangle of a mesh with normals and texture coordinates, its Bvh included.
//
// Triangles are in an order that depends on where they are alone, and each begins with its least corner, so
// that whatever is measured is the same to the bit however a file orders triangles and corners. (Of triangles
// that coincide the first in the file comes first; that only shows where their attributes differ.)
struct Surface {
    enum Has : uint8_t { has_normals = 1, has_texture = 2, has_colors = 4 };

    std::vector<Vec3d> positions;    // those that a triangle uses
    Bounds bounds;                   // of positions
    std::vector<uint32_t> vertices;  // 3 per triangle, into positions; counter-clockwise
    std::vector<uint32_t> wedges;    // 3 per triangle, into the attributes below
    std::vector<uint8_t> has;        // per triangle: of Has
    // Per wedge; empty where no triangle has it.
    std::vector<Vec3f> normals;
    std::vector<std::array<float, 2>> texture;  // TEXCOORD_0
    std::vector<std::array<float, 4>> colors;   // COLOR_0; alpha is 1 where there are three components

    size_t triangle_count() const { return has.size(); }
    Vec3d corner(size_t triangle, size_t c) const { return positions[vertices[3 * triangle + c]]; }
    std::array<Vec3d, 3> corners(size_t triangle) const {
        return {corner(triangle, 0), corner(triangle, 1), corner(triangle, 2)};
    }
    // Its length is twice the area.
    Vec3d facet_normal(size_t triangle) const {
        const auto [a, b, c] = corners(triangle);
        return cross(b - a, c - a);
    }
};

// A mesh in its own frame, to the bit.
Surface make_surface(const Mesh& mesh, const Watch& watch);

// The instances in the world; what a transform mirrors keeps its outside. Throws asset_malformed where a
// coordinate is so large that its square is no number.
Surface make_surface(const Scene& scene, std::span<const Instance> instances, const Watch& watch);

// Triangle i becomes the one that was order[i].
void reorder(Surface& surface, std::span<const uint32_t> order, const Watch& watch);

}  // namespace coppice
