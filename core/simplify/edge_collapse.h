// One simplification by collapsing edges to a point that an error chooses: the state and the rules that all
// such algorithms share. What differs between them is the CollapseError.
//
// Vertices inside the surface may be put anywhere, those of borders and seams on their edge; nothing else
// moves. Attributes of what moves are interpolated on the surface as it was (projection.h).
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
#include "core/simplify/wedge_map.h"
#include "core/simplify/wedge_values.h"

namespace coppice {

struct CollapseOptions {
    Freedom freedom = Freedom::anywhere;  // at most
    AttributeScales scales = {};
    GuardOptions guards = {};
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

    // With end points only, for who ranks edges otherwise.
    bool may_collapse(uint32_t removed, uint32_t kept);

    // Delaunay flips (delaunay_flips.h) between collapses.
    void flip_edges(const MayFlip& may_flip, const Watch& watch);

    void refuse_beyond_threshold() { refusals_.add_beyond_threshold(); }  // what is not even tried

    Simplified finish(StopReason reason, const Watch& watch) const;

  private:
    struct Merge {
        uint32_t removed = no_index, kept = no_index;
        Placed placed;
        bool moves = false;  // not at the end that stays
    };

    std::optional<Merge> best_merge(uint32_t owner, uint32_t other, bool ring_gathered);
    std::optional<Merge> merge_again(uint32_t owner, uint32_t other);
    std::optional<Merge> place(uint32_t removed, uint32_t kept, Freedom freedom);
    bool allowed(uint32_t removed, uint32_t kept, bool ring_gathered);
    bool parts_texture(uint32_t vertex) const;
    Freedom freedom_between(uint32_t a, uint32_t b) const;
    bool is_on_line(uint32_t vertex) const {
        return features_.kinds[vertex] == VertexKind::border || features_.kinds[vertex] == VertexKind::seam;
    }
    Refusal check(const Merge& merge);
    Refusal check_end_point(uint32_t removed, uint32_t kept);
    Refusal check_move(const Merge& merge);
    bool may_move_fan(uint32_t vertex, uint32_t other, const Merge& merge);
    Vec3f mean_facing(const Merge& merge) const;
    double deviation(const Merge& merge) const;
    void apply(const Merge& merge);
    void blend_wedges(uint32_t kept);

    WatchedSteps steps_;
    bool has_values_;  // that wedges get where they move
    CollapseOptions options_;
    AttributeClouds clouds_;
    Projection projection_;
    std::unique_ptr<CollapseError> error_;
    WedgeMap wedge_map_;
    WedgeValues values_;
    Neighbours around_, around_other_;
    std::vector<uint32_t> ring_;
    double next_deviation_ = 0;  // of the collapse that check() has just let through
};

}  // namespace coppice
