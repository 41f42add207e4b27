// One simplification by collapsing edges onto one of their ends: the state that every order of collapses
// shares.
//
// Who drives it asks for candidates, checks them, collapses, and stops when done(). Wedges and positions of
// the result are some of the source's, untouched, so whatever hangs on them (joints, morph deltas, custom
// values) survives.
#pragma once

#include <array>
#include <cstdint>
#include <limits>
#include <optional>
#include <span>

#include "core/base/watched_loop.h"
#include "core/simplify/algorithm.h"
#include "core/simplify/bounds_guard.h"
#include "core/simplify/collapse_mesh.h"
#include "core/simplify/collapse_rules.h"
#include "core/simplify/deviation.h"
#include "core/simplify/line_guard.h"
#include "core/simplify/neighbours.h"
#include "core/simplify/unified_error.h"
#include "core/simplify/uv_guard.h"
#include "core/simplify/wedge_map.h"

namespace coppice {

struct EndPointOptions {
    PlaneWeights weights = PlaneWeights::area;
    AttributeScales scales = {};
    bool lock_sharp_borders = false;
    std::span<const Transform> instances = {};  // how far errors reach in the world; see InstanceMetric
    // Gamma, in mesh units and the instances' proportions: dearer pairs are no candidates.
    std::optional<double> max_geometric_error = {};
};

// Moving a vertex onto a neighbour, and what that costs. Ordered by error, then by the neighbour.
struct Candidate {
    uint32_t kept = no_index;  // none
    double error = std::numeric_limits<double>::infinity();

    bool exists() const { return kept != no_index; }
    friend bool operator<(const Candidate& a, const Candidate& b) {
        return a.error != b.error ? a.error < b.error : a.kept < b.kept;
    }
};

class EndPointCollapse {
  public:
    // Keeps references to the source and the target, and a copy of the watch, which is looked at by the work
    // that candidates and collapses cost.
    EndPointCollapse(const Mesh& source, const Target& target, const EndPointOptions& options,
                     const Watch& watch);
    EndPointCollapse(const EndPointCollapse&) = delete;
    EndPointCollapse& operator=(const EndPointCollapse&) = delete;

    const CollapseMesh& mesh() const { return mesh_; }
    bool done() const;        // at or below the target's triangles and vertices
    double fraction() const;  // of the way there, 0..1

    // The cheapest candidate of a vertex that comes after the given one; the cheapest of all without.
    Candidate next_candidate(uint32_t removed, std::optional<Candidate> after = {});
    // What moving along one edge costs, where allowed.
    std::optional<double> cost(uint32_t removed, uint32_t kept);

    // Collapses unless a rule is broken.
    Refusal try_collapse(uint32_t removed, uint32_t kept);

    // Refusals are counted; they explain why nothing is left to collapse.
    void forget_refusals();
    StopReason reason_for_refusals() const;

    Simplified finish(StopReason reason, const Watch& watch) const;

  private:
    std::optional<double> cost_around(uint32_t removed, uint32_t kept);
    Refusal check(uint32_t removed, uint32_t kept);

    WatchedSteps steps_;
    const Mesh& source_;
    const Target& target_;
    std::optional<double> max_geometric_error_;
    CollapseMesh mesh_;
    Features features_;
    AttributeClouds clouds_;
    UnifiedError errors_;
    CollapseRules rules_;
    BoundsGuard bounds_;
    LineGuard lines_;
    UvGuard uvs_;
    Deviation deviation_;
    WedgeMap wedge_map_;
    Neighbours around_;
    uint32_t first_triangles_, first_vertices_;
    double next_deviation_ = 0;              // of the collapse that check() has just let through
    std::array<uint64_t, 5> refusals_ = {};  // by Refusal
    uint64_t beyond_max_geometric_error_ = 0;
};

}  // namespace coppice
