// One simplification by collapsing edges to a point that an error chooses: the state and the rules that all
// such algorithms share. What differs between them is the CollapseError.
//
// Vertices inside the surface may be put anywhere, those of borders and seams on their edge; nothing else
// moves. Attributes of what moves are interpolated on the surface as it was (projection.h).
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "core/base/watch.h"
#include "core/simplify/algorithm.h"
#include "core/simplify/attribute_cloud.h"
#include "core/simplify/bounds_guard.h"
#include "core/simplify/cheapest_first.h"
#include "core/simplify/collapse_mesh.h"
#include "core/simplify/collapse_rules.h"
#include "core/simplify/deviation.h"
#include "core/simplify/line_guard.h"
#include "core/simplify/neighbours.h"
#include "core/simplify/projection.h"
#include "core/simplify/target.h"
#include "core/simplify/uv_guard.h"
#include "core/simplify/wedge_map.h"
#include "core/simplify/wedge_values.h"

namespace coppice {

// Where the vertex that stays may go.
enum class Freedom : uint8_t { end_point, segment, anywhere };

struct Placed {
    Vec3d at;
    double error = 0;
};

// What the error knows of the mesh. Lives as long as the collapse.
struct CollapseParts {
    const CollapseMesh& mesh;
    std::span<const FeatureEdge> features;
    AttributeClouds& clouds;
    Projection& projection;  // scratch
};

class CollapseError {
  public:
    CollapseError() = default;
    virtual ~CollapseError() = default;
    CollapseError(const CollapseError&) = delete;
    CollapseError& operator=(const CollapseError&) = delete;

    // Where `removed` and `kept` are best merged, and what that costs. end_point: at `kept`.
    virtual Placed place(uint32_t removed, uint32_t kept, Freedom freedom,
                         const std::vector<uint32_t>& wedge_map) const = 0;
    // To be called with every collapse, before the mesh changes; the clouds' values at `kept` are the new
    // ones.
    virtual void merge(uint32_t removed, uint32_t kept, const std::vector<uint32_t>& wedge_map) = 0;
};

struct CollapseOptions {
    Freedom freedom = Freedom::anywhere;  // at most
    AttributeScales scales = {};
    std::optional<double> error_limit = {};  // of CollapseError: dearer edges are no candidates
};

class EdgeCollapse {
  public:
    using MakeError = std::function<std::unique_ptr<CollapseError>(const CollapseParts&)>;

    // Keeps references to the source and the target.
    EdgeCollapse(const Mesh& source, const Target& target, const CollapseOptions& options,
                 const MakeError& make_error, const Watch& watch);
    EdgeCollapse(const EdgeCollapse&) = delete;
    EdgeCollapse& operator=(const EdgeCollapse&) = delete;

    const CollapseMesh& mesh() const { return mesh_; }
    bool done() const { return count_.is_met(mesh_); }
    double fraction() const { return count_.fraction(mesh_); }  // of the way there, 0..1

    // As CheapestFirst asks. With end points only, the owner of an edge is the end that goes; else the end
    // with the lower index.
    EdgeCandidate next_candidate(uint32_t owner, std::optional<EdgeCandidate> after);
    std::optional<double> cost(uint32_t owner, uint32_t other);
    std::optional<Collapsed> try_collapse(uint32_t owner, uint32_t other);
    void ring(uint32_t vertex, std::vector<uint32_t>& out);

    // With end points only, for who ranks edges otherwise.
    bool may_collapse(uint32_t removed, uint32_t kept);

    // Refusals are counted; they explain why nothing is left to collapse.
    void forget_refusals();
    StopReason reason_for_refusals() const;

    Simplified finish(StopReason reason, const Watch& watch) const;

  private:
    struct Merge {
        uint32_t removed = no_index, kept = no_index;
        Placed placed;
        bool moves = false;  // not at the end that stays
    };

    std::optional<Merge> best_merge(uint32_t owner, uint32_t other, bool ring_gathered);
    std::optional<Merge> place(uint32_t removed, uint32_t kept, Freedom freedom);
    bool allowed(uint32_t removed, uint32_t kept, bool ring_gathered);
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

    const Mesh& source_;
    const Target& target_;
    bool has_values_;  // that wedges get where they move
    CollapseOptions options_;
    CollapseMesh mesh_;
    Features features_;
    AttributeClouds clouds_;
    Projection projection_;
    std::unique_ptr<CollapseError> error_;
    CollapseRules rules_;
    BoundsGuard bounds_;
    LineGuard lines_;
    UvGuard uvs_;
    Deviation deviation_;
    WedgeMap wedge_map_;
    WedgeValues values_;
    Neighbours around_, around_other_;
    std::vector<uint32_t> ring_;
    TargetCount count_;
    double next_deviation_ = 0;              // of the collapse that check() has just let through
    std::array<uint64_t, 5> refusals_ = {};  // by Refusal
    uint64_t beyond_error_limit_ = 0;
};

}  // namespace coppice
