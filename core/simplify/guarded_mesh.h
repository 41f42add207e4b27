// A mesh that is being simplified, with what keeps it sound: what all algorithms that change a mesh step by
// step share, whatever their steps are (collapsed edges, contracted stars, removed vertices).
#pragma once

#include "core/base/watch.h"
#include "core/simplify/algorithm.h"
#include "core/simplify/bounds_guard.h"
#include "core/simplify/collapse_mesh.h"
#include "core/simplify/collapse_rules.h"
#include "core/simplify/deviation.h"
#include "core/simplify/line_guard.h"
#include "core/simplify/refusal_counts.h"
#include "core/simplify/target.h"
#include "core/simplify/uv_guard.h"
#include "core/simplify/vertex_kind.h"

namespace coppice {

struct GuardOptions {
    bool lock_sharp_borders = false;  // for errors that do not see borders; see vertex_kind.h
    bool lock_borders = false;        // no vertex of one goes or moves
    double tolerance = 1;  // part of what lines and the box may move; less if some of it is used up
};

// One object, one thread.
class GuardedMesh {
  public:
    GuardedMesh(const GuardedMesh&) = delete;
    GuardedMesh& operator=(const GuardedMesh&) = delete;

    const CollapseMesh& mesh() const { return mesh_; }
    VertexKind kind(uint32_t vertex) const { return rules_.kind(vertex); }

    bool done() const { return count_.is_met(mesh_); }
    double fraction() const { return count_.fraction(mesh_); }  // of the way there, 0..1

    // Refusals are counted; they explain why nothing is left to do.
    void forget_refusals() { refusals_ = {}; }
    StopReason reason_for_refusals() const { return refusals_.reason(); }

  protected:
    // Keeps references to the source and the target.
    GuardedMesh(const Mesh& source, const Target& target, const GuardOptions& options, const Watch& watch);
    ~GuardedMesh() = default;

    // Of a step after which the surface has moved so far, in mesh units.
    Refusal check_deviation(double deviation) const {
        const bool too_far = target_.error_model_units && deviation > *target_.error_model_units;
        return too_far ? Refusal::error : Refusal::none;
    }

    Simplified simplified(Mesh mesh, StopReason reason) const;

    const Mesh& source_;
    const Target& target_;
    CollapseMesh mesh_;
    Features features_;  // at the start; what a vertex is like now: kind()
    CollapseRules rules_;
    BoundsGuard bounds_;
    LineGuard lines_;
    UvGuard uvs_;
    Deviation deviation_;
    TargetCount count_;
    RefusalCounts refusals_;
};

}  // namespace coppice
