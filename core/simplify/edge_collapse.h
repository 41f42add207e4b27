// One simplification by collapsing edges to a point that an error chooses: the state and the rules that all
// such algorithms share. What differs between them is the CollapseError.
//
// Vertices inside the surface may be put anywhere, those of borders and seams on their edge; nothing else
// moves. Attributes of what moves are interpolated on the surface as it was (projection.h).
//
// Where a pair distance is set, vertices of open borders that near each other (vertex_pairs.h) may be joined,
// too, as if an edge led from one to the other: gaps close, parts become one. No edge gets a third triangle
// by that, sheets are joined only so that both face the same way, and no texture or material is drawn over a
// gap: both ends must agree in all values but normals and colours. Two parts touch in one vertex only where
// more of their borders is near enough to follow. Borders move by no more than line_guard.h allows; where two
// of them become one edge they are borders no more.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <vector>

#include "core/base/watched_loop.h"
#include "core/simplify/attribute_cloud.h"
#include "core/simplify/cheapest_first.h"
#include "core/simplify/collapse_error.h"
#include "core/simplify/delaunay_flips.h"
#include "core/simplify/guarded_mesh.h"
#include "core/simplify/neighbours.h"
#include "core/simplify/projection.h"
#include "core/simplify/vertex_classifier.h"
#include "core/simplify/vertex_pairs.h"
#include "core/simplify/wedge_map.h"
#include "core/simplify/wedge_values.h"

namespace coppice {

struct CollapseOptions {
    Freedom freedom = Freedom::anywhere;  // at most
    AttributeScales scales = {};
    GuardOptions guards = {};
    double pair_distance = 0;  // mesh units; 0: only edges are collapsed
    // The area test of GAPS (Erikson and Manocha 1999): by which part a join may change the area around it;
    // by no more than a disc of the pair distance, too. None: no test.
    std::optional<double> area_tolerance = {};
};

class EdgeCollapse : public GuardedMesh {
  public:
    using MakeError = std::function<std::unique_ptr<CollapseError>(const CollapseParts&)>;

    // Keeps references to the source and the target, and a copy of the watch, which is looked at by the work
    // that candidates and collapses cost.
    EdgeCollapse(const Mesh& source, const Target& target, const CollapseOptions& options,
                 const MakeError& make_error, const Watch& watch);

    // As CheapestFirst asks. With end points only, the owner of an edge is the end that goes; else the end
    // with the lower index.
    Candidate next_candidate(uint32_t owner, std::optional<Candidate> after);
    std::optional<double> cost(uint32_t owner, uint32_t other);
    std::optional<Collapsed> try_collapse(uint32_t owner, uint32_t other);
    void ring(uint32_t vertex, std::vector<uint32_t>& out);

    // Whether a vertex may be in pairs; never without a pair distance.
    bool is_paired(uint32_t vertex) const { return joins_ && joins_->pairs.contains(vertex); }
    bool has_pairs() const { return joins_ && !joins_->pairs.empty(); }
    // Vertices that are paired have other candidates then. Over 0, with a pair distance set before.
    void set_pair_distance(double distance, const Watch& watch) {
        joins_->pairs.set_distance(distance, watch);
    }

    // With end points only, for who ranks edges otherwise.
    bool may_collapse(uint32_t removed, uint32_t kept);

    // Delaunay flips (delaunay_flips.h) between collapses.
    void flip_edges(const MayFlip& may_flip, const Watch& watch);

    void refuse_beyond_threshold() { refusals_.add_beyond_threshold(); }  // what is not even tried

    Simplified finish(StopReason reason, const Watch& watch) const;

  private:
    // What holds two vertices together.
    enum class Tie : uint8_t { none, edge, nearness };

    struct Merge {
        uint32_t removed = no_index, kept = no_index;
        Placed placed;
        bool moves = false;  // not at the end that stays; a join always counts as moving
        Tie tie = Tie::edge;
    };

    // What only those need that join.
    struct Joins {
        VertexPairs pairs;
        VertexClassifier classifier;
        std::vector<FeatureEdge> lines = {};  // scratch
    };

    Tie tie_between(uint32_t a, uint32_t b) const;
    std::optional<Merge> best_merge(uint32_t owner, uint32_t other, Tie tie, bool ring_gathered);
    std::optional<Merge> merge_again(uint32_t owner, uint32_t other, Tie tie);
    std::optional<Merge> place(uint32_t removed, uint32_t kept, Tie tie, Freedom freedom);
    bool allowed(uint32_t removed, uint32_t kept, Tie tie, bool ring_gathered);
    bool find_wedges(uint32_t removed, uint32_t kept, Tie tie);
    void neighbours(uint32_t vertex, std::vector<uint32_t>& out);
    bool parts_texture(uint32_t vertex) const;
    Freedom freedom_between(uint32_t a, uint32_t b) const;
    bool is_on_line(uint32_t vertex) const {
        return kind(vertex) == VertexKind::border || kind(vertex) == VertexKind::seam;
    }
    Refusal check(const Merge& merge);
    Refusal check_end_point(uint32_t removed, uint32_t kept);
    Refusal check_move(const Merge& merge);
    bool lines_allow(const Merge& merge) const;
    bool may_join(const Merge& merge);
    bool keeps_area(const Merge& merge) const;
    bool may_move_fan(uint32_t vertex, uint32_t other, const Merge& merge);
    Vec3f mean_facing(const Merge& merge) const;
    double deviation(const Merge& merge) const;
    void apply(const Merge& merge);
    void settle_pairs(const Merge& merge);
    void settle(uint32_t vertex);
    void blend_wedges(uint32_t kept);

    WatchedSteps steps_;
    bool has_values_;  // that wedges get where they move
    CollapseOptions options_;
    AttributeClouds clouds_;
    Projection projection_;
    std::unique_ptr<CollapseError> error_;
    WedgeMap wedge_map_;
    WedgeValues values_;
    std::unique_ptr<Joins> joins_;  // none without a pair distance
    Neighbours around_, around_other_;
    std::vector<uint32_t> ring_;
    double next_deviation_ = 0;  // of the collapse that check() has just let through
};

}  // namespace coppice
