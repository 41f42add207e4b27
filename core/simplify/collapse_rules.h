// Whether moving all triangles of one vertex to a neighbour keeps the surface sound.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include "core/simplify/collapse_mesh.h"
#include "core/simplify/neighbours.h"
#include "core/simplify/vertex_kind.h"

namespace coppice {

// The first rule that a collapse breaks.
enum class Refusal : uint8_t {
    none,
    locked,    // by the kinds of its vertices, or a seam without counterpart
    topology,  // it would join, close, duplicate or drop something, flip or flatten a triangle, or move a
               // line
    bounds,    // the box of the mesh would shrink
    error,     // beyond the target's error
};

// Vertices of more triangles than this are not removed, which keeps every check short, whatever the mesh.
inline constexpr uint32_t largest_removable_valence = 128;

class CollapseRules {
  public:
    CollapseRules(const CollapseMesh& mesh, std::vector<VertexKind> kinds, const Watch& watch = {});

    // Whether kinds allow the collapse along this edge. `around` holds the neighbours of `removed`, if
    // reads_neighbours(removed).
    bool kinds_allow(uint32_t removed, uint32_t kept, const Neighbours& around) const;

    bool reads_neighbours(uint32_t removed) const {
        return kinds_[removed] == VertexKind::border || kinds_[removed] == VertexKind::complex;
    }

    // Link condition (Dey and others 1999), no duplicate triangle, no edge with more triangles than before
    // where that makes it non-manifold, nothing dropped; no triangle turned by more than about 75 degrees,
    // neither now nor since the start, nor away from what the surface faced at its corners; none made
    // degenerate. The edge exists.
    Refusal check(uint32_t removed, uint32_t kept);

    // Corners of other vertices than the pair that checks have looked at until now: their work beyond its
    // rings. Bounded for each check, whatever the mesh.
    uint64_t searched() const { return searched_; }

    // What check() asks of each triangle that moves: whether the one at this corner may have it at `to`,
    // where the surface faced `facing` (unit, or zero where that is not known).
    bool keeps_orientation(uint32_t corner, Vec3d to, Vec3f facing) const;

    // The same of a triangle that takes the place of others, between vertices that stay: its unit normal, or
    // none if it may not be. facing: of what it replaces.
    std::optional<Vec3f> normal_of_filling(const std::array<uint32_t, 3>& vertices, Vec3f facing) const;

    VertexKind kind(uint32_t vertex) const { return kinds_[vertex]; }
    void set_kind(uint32_t vertex, VertexKind kind) { kinds_[vertex] = kind; }
    // Where the surface faced at a vertex at the start. Of one that stands for several now, their mean.
    Vec3f facing(uint32_t vertex) const { return facing_[vertex]; }
    void set_facing(uint32_t vertex, Vec3f facing) { facing_[vertex] = facing; }

    // Of each triangle at the start: unit, zero where it had no area.
    const std::vector<Vec3f>& first_normals() const { return first_normals_; }

    // The first part of check(). joins: no edge leads from one to the other. Then neighbours of both must be
    // where two borders become one edge inside the surface, with the same chart on both sides.
    bool keeps_topology(uint32_t removed, uint32_t kept, bool joins = false);
    // Those neighbours, after keeps_topology() has let a join through.
    const std::vector<uint32_t>& zipped() const { return zipped_; }
    // Whether a join closes a border, or could be followed by one that does: where borders of both run along
    // each other, no farther apart than the distance. Else two parts would touch in a vertex, which holds
    // both and saves no triangle. After keeps_topology().
    bool closes_or_leads_on(uint32_t removed, uint32_t kept, double distance);
    // The first part of kinds_allow(), all that there is for a join.
    bool kinds_allow_join(uint32_t removed, uint32_t kept) const;

    // In either orientation. True, too, where all three have too many triangles to search.
    bool has_triangle(std::array<uint32_t, 3> corners);

  private:
    bool duplicates(uint32_t removed, uint32_t kept);
    struct Spoke {
        bool runs_outwards = false;  // in one of its triangles
        uint32_t chart = no_index;   // there, at the far end
    };
    Spoke spoke(uint32_t vertex, uint32_t neighbour) const;
    bool closes_border(uint32_t removed, uint32_t kept, uint32_t common) const;
    bool keeps_orientation(uint32_t removed, uint32_t kept) const;
    uint32_t edge_uses(uint32_t vertex, uint32_t kept, bool ring_gathered);

    struct BorderEnd {
        uint32_t vertex = 0;
        bool runs_outwards = false;
    };
    void gather_border_ends(uint32_t vertex, const Neighbours& around, std::vector<BorderEnd>& ends) const;

    const CollapseMesh& mesh_;
    std::vector<VertexKind> kinds_;
    std::vector<Vec3f> first_normals_;  // see first_normals()
    std::vector<Vec3f> facing_;         // per vertex, where the surface faced at the start; see facing()
    Neighbours around_removed_, around_kept_;
    std::vector<uint32_t> shared_;  // per neighbour of `removed`: triangles that also hold `kept`
    std::vector<uint32_t> zipped_;  // see zipped()
    std::vector<BorderEnd> removed_ends_, kept_ends_;
    uint64_t searched_ = 0;
};

}  // namespace coppice
