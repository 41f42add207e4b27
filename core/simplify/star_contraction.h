// One simplification by contracting small connected sets of vertices to points: the state that the clustering
// algorithms share, as EdgeCollapse is for edges.
//
// A set may be contracted when
//   - its outside stays: the edges opposite to it, of the triangles with one corner in it, are one closed
//     cycle, or one path where it lies at a border, and it has no hole or handle;
//   - no triangle that moves is turned over, flattened (collapse_rules.h) or mirrored in its texture
//     (uv_guard.h), and the bounding box stays (bounds_guard.h);
//   - at most one of its vertices is on a seam or a corner of lines: then that stays where it is, with its
//     values, and takes the others; borders shorten along themselves only, and stay within a tolerance
//     (line_guard.h).
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "core/base/watch.h"
#include "core/simplify/guarded_mesh.h"
#include "core/simplify/wedge_groups.h"
#include "core/simplify/wedge_values.h"

namespace coppice {

// Where a set of vertices goes, and how much of the attributes each of them gives.
struct Placement {
    Vec3d point;
    std::span<const double> weights;  // one per vertex of the set; >= 0, summing to 1
};

class StarContraction : public GuardedMesh {
  public:
    // Keeps references to the source and the target.
    StarContraction(const Mesh& source, const Target& target, const Watch& watch);

    using GuardedMesh::mesh;
    CollapseMesh& mesh() { return mesh_; }
    const UvGuard& uvs() const { return uvs_; }

    // Whether kinds of vertices allow it: the first rule, and quick.
    bool kinds_allow(std::span<const uint32_t> vertices) const;
    // Triangles that would go, if nothing but kinds mattered.
    uint32_t triangles_saved(std::span<const uint32_t> vertices) const;

    // Contracts two or more distinct live vertices unless a rule is broken. Where lines or locked vertices
    // are among them, these say where to. The first of the set that kinds favour stays and stands for all.
    Refusal try_contract(std::span<const uint32_t> vertices, const Placement& placement);

    Simplified finish(StopReason reason, const Watch& watch) const;

  private:
    Refusal check(std::span<const uint32_t> vertices, const Placement& placement);
    bool place(std::span<const uint32_t> vertices, const Placement& placement);
    bool gather_star(std::span<const uint32_t> vertices);
    bool has_sound_link(size_t set_size);
    bool keeps_lines(std::span<const uint32_t> vertices) const;
    Vec3f mean_facing(std::span<const uint32_t> vertices) const;
    double deviation(std::span<const uint32_t> vertices) const;
    void contract(std::span<const uint32_t> vertices);
    bool stays(uint32_t corner) const { return moves_nothing_ && mesh_.corner_vertex(corner) == kept_; }
    bool changes_line() const { return borders_ + anchors_ > 1 && borders_ > 0; }

    WedgeValues values_;
    WedgeGroups groups_;

    // Of the set that is looked at.
    uint32_t kept_ = no_index, borders_ = 0, anchors_ = 0;
    Vec3d point_;
    bool moves_nothing_ = false;  // of the vertex that stays
    std::vector<double> weights_;
    std::vector<uint32_t> fan_;   // corners of triangles with one corner in the set
    std::vector<uint32_t> gone_;  // triangles with more
    double next_deviation_ = 0;

    // Per vertex, valid where the round is this one: in the set, a start or an end of an edge of its link.
    struct Mark {
        uint32_t in_set = 0, starts = 0, ends = 0;
        uint32_t next = no_index;  // along the link
    };
    std::vector<Mark> marks_;
    uint32_t round_ = 0;
};

}  // namespace coppice
