// A mesh that edges are collapsed in: flat arrays that change in place, no allocation after construction.
//
// Corners (3 * triangle + 0..2) of a vertex form a doubly linked list, so a collapse costs the ring of the
// vertex that goes, whatever the valence of the one that stays. Wedges are the source's, split by material
// slot: a wedge here belongs to one slot, so mapping wedge to wedge within a slot can never give a triangle
// attributes of another slot. Wedges of a vertex are contiguous, and in it those that may be merged at a cost
// (a chart, see wedge_chart).
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "core/base/watched_loop.h"
#include "core/mesh/bounds.h"
#include "core/mesh/mesh.h"
#include "core/simplify/wedge_values.h"

namespace coppice {

inline constexpr uint32_t no_index = UINT32_MAX;

class CollapseMesh {
  public:
    // Triangles with two corners at one vertex are dead from the start.
    explicit CollapseMesh(const Mesh& source, const Watch& watch = {});

    uint32_t vertex_count() const { return static_cast<uint32_t>(positions_.size()); }  // live or not
    uint32_t wedge_count() const { return static_cast<uint32_t>(wedge_source_.size()); }
    uint32_t triangle_count() const { return static_cast<uint32_t>(corner_vertex_.size() / 3); }
    uint32_t live_triangles() const { return live_triangles_; }
    uint32_t live_vertices() const { return live_vertices_; }  // those with a triangle

    // Relative to the centre of the source's box, for precision.
    Vec3d position(uint32_t vertex) const { return positions_[vertex]; }
    const Bounds& box() const { return box_; }  // of the used vertices, at the start

    bool is_live_triangle(uint32_t triangle) const { return corner_vertex_[3 * triangle] != no_index; }
    bool is_live_vertex(uint32_t vertex) const { return first_corner_[vertex] != no_index; }
    uint32_t valence(uint32_t vertex) const { return valence_[vertex]; }  // triangles

    static uint32_t next_corner(uint32_t corner) { return corner % 3 == 2 ? corner - 2 : corner + 1; }
    static uint32_t previous_corner(uint32_t corner) { return corner % 3 == 0 ? corner + 2 : corner - 1; }
    uint32_t corner_vertex(uint32_t corner) const { return corner_vertex_[corner]; }
    std::array<uint32_t, 3> vertices(uint32_t triangle) const {
        return {corner_vertex_[3 * triangle], corner_vertex_[3 * triangle + 1],
                corner_vertex_[3 * triangle + 2]};
    }
    uint32_t corner_wedge(uint32_t corner) const { return corner_wedge_[corner]; }

    // for (auto c = first_corner(v); c != no_index; c = corner_after(c)): the live corners of a vertex.
    uint32_t first_corner(uint32_t vertex) const { return first_corner_[vertex]; }
    uint32_t corner_after(uint32_t corner) const { return after_[corner]; }

    uint32_t wedge_begin(uint32_t vertex) const { return wedge_begin_[vertex]; }
    uint32_t wedge_end(uint32_t vertex) const { return wedge_begin_[vertex + 1]; }
    uint32_t wedge_slot(uint32_t wedge) const { return wedge_slot_[wedge]; }
    uint32_t wedge_source(uint32_t wedge) const { return wedge_source_[wedge]; }
    // The first wedge of its chart: the wedges of a vertex and a slot that differ in normals, tangents or
    // colours only. Across charts (other UVs, custom values, joints, handedness) nothing may be merged.
    uint32_t wedge_chart(uint32_t wedge) const { return wedge_chart_[wedge]; }

    // Moves every triangle of `removed` to `kept`; those that hold both die. wedge_map holds, for each wedge
    // of `removed` in order, the wedge of `kept` that takes its place (no_index for wedges that no corner
    // uses).
    void collapse(uint32_t removed, uint32_t kept, const std::vector<uint32_t>& wedge_map);

    // For what is not the collapse of an edge. Wedges may then be used at other vertices than they began at:
    // such a mesh is extracted with the values of its wedges.
    void set_corner(uint32_t corner, uint32_t vertex, uint32_t wedge);
    void remove_triangle(uint32_t triangle);
    void move(uint32_t vertex, Vec3d position);

    // The source with the live triangles and what they use.
    Mesh extract(const Mesh& source, const Watch& watch = {}) const;
    // The same after wedges were blended or vertices moved. Moved positions are no longer those that the
    // source stored, so storage becomes float32.
    Mesh extract(const Mesh& source, const WedgeValues& values, const Watch& watch = {}) const;
    // What WedgeValues is made of.
    std::span<const uint32_t> wedge_sources() const { return wedge_source_; }

  private:
    void link(uint32_t corner);
    void unlink(uint32_t corner);

    std::vector<Vec3d> positions_;
    std::vector<bool> moved_;  // per vertex; empty until one is
    Vec3d centre_;             // of the source's box
    Bounds box_;
    std::vector<uint32_t> corner_vertex_, corner_wedge_;  // 3 per triangle; no_index when dead
    std::vector<uint32_t> after_, before_;                // per corner: its vertex' list
    std::vector<uint32_t> first_corner_, valence_;        // per vertex
    std::vector<uint32_t> wedge_begin_;                   // per vertex, + 1
    std::vector<uint32_t> wedge_slot_, wedge_source_, wedge_chart_;
    uint32_t live_triangles_ = 0, live_vertices_ = 0;
};

// Calls use(triangle, its vertices) for the live ones, in order; looks at the watch.
template <typename Use>
void for_each_triangle(const CollapseMesh& mesh, const Watch& watch, Use&& use) {
    watched_loop(mesh.triangle_count(), watch, [&](size_t i) {
        const auto triangle = static_cast<uint32_t>(i);
        if (mesh.is_live_triangle(triangle)) use(triangle, mesh.vertices(triangle));
    });
}

}  // namespace coppice
