// Passes of edge collapses over a packed mesh. A pass ranks all edges by what their best point costs, and
// takes the cheap ones, cheapest first, each vertex once; then the mesh is packed again.
//
// Only what is simple is treated: the inside of a chart, borders, seams between two charts; a vertex where
// more meets stays. Costs are quadrics of planes (Garland and Heckbert 1997) and of attributes (Hoppe 1999).
// The point is the least one among those that keep the volume (Lindstrom and Turk 1998): the planes alone put
// it outside of whatever bulges, which is most of their error.
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <vector>

#include "core/base/watch.h"
#include "core/simplify/algorithm.h"
#include "core/simplify/attribute_quadric/centred_quadric.h"
#include "core/simplify/attribute_quadric/lanes.h"
#include "core/simplify/attribute_quadric/packed_mesh.h"
#include "core/simplify/attribute_quadric/packed_ring.h"
#include "core/simplify/attribute_quadric/wedge_quadrics.h"
#include "core/simplify/wedge_values.h"

namespace coppice {

// Part of what lines and the box may move by; the rest is for who goes on from there.
inline constexpr double packed_tolerance = 0.5;

struct PackedOptions {
    AttributeWeights weights = {};
    bool lock_borders = false;
    double share_of_pass = 1;  // of what is to go, about, in one pass
    // After each pass planes are those of the mesh as it is, instead of all that a vertex has stood for
    // (Lindstrom and Turk 1999, "Evaluation of memoryless simplification"): more exact, as long as a pass
    // goes not far.
    bool measures_anew = false;
    std::function<double(Vec3d)> instance_weight = {};  // as PlaneOptions has it, about 1
};

// One object, one thread.
class PackedCollapse {
  public:
    // Keeps a reference to the source.
    PackedCollapse(const Mesh& source, const PackedOptions& options, const Watch& watch);

    // Until the target is met, or nothing goes any more.
    void run(const Target& target, const Watch& watch);

    bool is_met(const Target& target) const;
    // How far the surface has moved, at most, in mesh units: an estimate. Without a limit, the largest mean
    // distance from the planes that a vertex stands for.
    double error_model_units() const;

    Mesh extract(const Watch& watch) const;

  private:
    // Kinds and edges decide who goes, and whether the other may move for it.
    struct Merge {
        uint32_t removed = no_index, kept = no_index;
        bool moves = false;
    };

    void find_facing(const Watch& watch);
    void add_planes(const Watch& watch);
    void add_lines(const Watch& watch);
    void rank(const Watch& watch);
    float cost_of(uint64_t place, const Watch& watch) const;
    void sort_up_to(float dearest, const Watch& watch);
    std::optional<Merge> merge_along(uint32_t from) const;  // a corner, to the next one
    std::optional<Merge> line_merge(uint32_t from, uint32_t to) const;
    void find_pairs(const Merge& merge);
    CentredQuadric planes_of(const Merge& merge, Vec3f offset) const;
    float cost(const Merge& merge);
    void cost_planes(const std::array<uint32_t, lane_count>& corners, uint32_t count);

    // How many may go yet.
    struct ToGo {
        uint64_t triangles = 0, vertices = 0;
    };
    ToGo to_go(const Target& target) const;
    uint64_t pass(const ToGo& to_go, const Watch& watch);
    void pack(const Watch& watch);
    bool is_in_box(Vec3f point) const;
    uint32_t try_collapse(const Merge& merge);
    float distance_after(const Merge& merge, Vec3f at) const;
    bool gather(uint32_t vertex, PackedRing& ring) const;
    void gather_fan(uint32_t vertex, uint32_t other, Vec3f origin, const PackedRing& ring, PackedFan& fan);
    bool leaves_none_out(const Merge& merge) const;
    std::optional<Vec3f> place(const Merge& merge, const CentredQuadric& q, Vec3f offset);
    bool keeps_texture(const Merge& merge, Vec3f at) const;
    std::optional<float> line_away(const Merge& merge, Vec3f at) const;
    uint32_t line_neighbour(uint32_t vertex, uint32_t but) const;
    void apply(const Merge& merge, Vec3f at, const CentredQuadric& q, Vec3f offset);

    uint32_t now(uint32_t vertex) const { return vertex_becomes_[vertex]; }
    // Each vertex takes part in one collapse a pass.
    bool is_taken(uint32_t vertex) const { return now(vertex) != vertex || changed_[vertex] != 0; }
    uint32_t wedge_now(uint32_t wedge) const {
        return mesh_.has_wedges() ? wedge_becomes_[wedge] : vertex_becomes_[wedge];
    }

    const Mesh& source_;
    PackedOptions options_;
    PackedMesh mesh_;
    WedgeQuadrics attributes_;
    std::vector<uint32_t> first_wedges_;  // the source's, by the number that a wedge had at the start
    WedgeValues values_;                  // of what has no quadric: skins, tangents, shapes to morph to
    bool blends_values_ = false;
    std::vector<uint32_t> wedge_origin_;  // per wedge: its number at the start
    std::vector<CentredQuadric> planes_;  // per vertex
    std::vector<Vec3f> facing_;           // per vertex: where the surface faced at the start; unit or zero
    std::vector<float> away_;             // per vertex of a line: how far it may be from where it was
    std::vector<bool> moved_;             // per vertex
    bool carries_error_ = false;
    float error_limit_ = 0, largest_error_ = 0;  // diagonals
    std::vector<float> carried_;  // per vertex, with a limit or planes anew: how far it may be off

    // Of a pass.
    std::vector<float> costs_;      // per corner, of the edge to the next; none for edges that may not go
    std::vector<uint8_t> changed_;  // per vertex: in the last pass
    std::vector<uint32_t> order_, sorted_;  // corners of edges, the cheap ones
    float patience_ = 0;
    std::vector<uint32_t> vertex_becomes_, wedge_becomes_;

    // Of a collapse.
    std::array<WedgeQuadrics::Pair, 2> pairs_;
    uint32_t pair_count_ = 0;
    PackedRing removed_ring_, kept_ring_;  // as they are now, in the course of the pass
    PackedFan removed_fan_, kept_fan_;
    Constraint<float> volume_;
};

}  // namespace coppice
