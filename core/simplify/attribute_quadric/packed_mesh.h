// A mesh for passes of collapses: flat arrays without gaps, renumbered after each pass, so that what is
// looked at together stays together in memory however little of the mesh is left.
//
// Positions are relative to the centre of the source's box, in its diagonals. Wedges are those of
// WedgeCharts; where every vertex has one alone, wedges are vertices and nothing is stored for them.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "core/base/watched_loop.h"
#include "core/mesh/mesh.h"
#include "core/simplify/vertex_kind.h"

namespace coppice {

// New numbers of what is left; no_index for what is gone.
struct Renumbering {
    std::vector<uint32_t> vertices, wedges, triangles;
    uint32_t vertices_left = 0, wedges_left = 0, triangles_left = 0;
};

// Moves what is stored per vertex, wedge or triangle, `stride` values each, to its new place.
template <typename T>
void renumber(std::vector<T>& values, std::span<const uint32_t> numbers, size_t left, const Watch& watch,
              size_t stride = 1) {
    watched_loop(numbers.size(), watch, [&](size_t i) {
        if (numbers[i] == no_index || numbers[i] == i) return;
        for (size_t k = 0; k < stride; ++k) values[numbers[i] * stride + k] = values[i * stride + k];
    });
    values.resize(left * stride);
}

struct PackedMesh {
    static constexpr uint32_t largest_valence = 48;

    // A triangle as one of its vertices sees it: the other two, in order.
    struct Spoke {
        uint32_t next = 0, previous = 0;
    };

    // Triangles with two corners at one vertex are left out.
    PackedMesh(const Mesh& source, const Watch& watch);

    uint32_t vertex_count() const { return static_cast<uint32_t>(positions.size()); }
    uint32_t triangle_count() const { return static_cast<uint32_t>(triangles.size() / 3); }
    uint32_t wedge_count() const { return static_cast<uint32_t>(wedge_source.size()); }
    bool has_wedges() const { return !corner_wedges.empty(); }  // else they are the vertices
    uint32_t valence(uint32_t vertex) const { return first_spoke[vertex + 1] - first_spoke[vertex]; }

    // The wedges at the corners that a spoke stands for: its vertex', its next's, its previous'.
    std::array<uint32_t, 3> wedges(uint32_t vertex, uint32_t spoke) const {
        if (!has_wedges()) return {vertex, spokes[spoke].next, spokes[spoke].previous};
        const uint32_t corner = spoke_corner[spoke], k = corner % 3, first = corner - k;
        return {corner_wedges[corner], corner_wedges[first + (k + 1) % 3],
                corner_wedges[first + (k + 2) % 3]};
    }

    // Vertices of more triangles stay, and nothing is merged into them: rings are searched again and again.
    bool is_hub(uint32_t vertex) const { return valence(vertex) > largest_valence; }

    // A spoke of `vertex` whose next (previous) is `other`: a triangle that runs along the edge (against it).
    std::optional<uint32_t> along(uint32_t vertex, uint32_t other) const;
    std::optional<uint32_t> against(uint32_t vertex, uint32_t other) const;

    // Given what took the place of each vertex and wedge (itself where nothing did), drops the triangles that
    // have lost an edge, and what none uses any more.
    Renumbering compact(std::span<const uint32_t> vertex_becomes, std::span<const uint32_t> wedge_becomes,
                        const Watch& watch);

    std::vector<Vec3f> positions;
    std::vector<VertexKind> kinds;
    std::vector<uint32_t> vertex_source;
    std::vector<uint32_t> triangles;      // three vertices each
    std::vector<uint32_t> corner_wedges;  // three each; empty where wedges are vertices
    std::vector<uint32_t> triangle_slot;
    std::vector<uint32_t> wedge_source;  // per wedge, the source's
    std::vector<uint32_t> first_spoke;   // per vertex, + 1
    std::vector<Spoke> spokes;           // by vertex, in the order of triangles
    std::vector<uint32_t> spoke_corner;  // 3 * triangle + 0..2; with wedges only
    Vec3d centre;                        // mesh units
    double diagonal = 0;                 // mesh units
    Vec3f half_box;                      // from the centre to the sides

  private:
    void take_triangles(const Mesh& source, const Watch& watch);
    void link(const Watch& watch);
    VertexKind kind_of(uint32_t vertex) const;
    bool is_plain(uint32_t vertex) const;
    bool is_one_fan(uint32_t vertex) const;
    void drop_unused_vertices(const Watch& watch);
    void lock_extremes();
};

}  // namespace coppice
