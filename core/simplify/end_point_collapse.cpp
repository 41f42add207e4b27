#include "core/simplify/end_point_collapse.h"

namespace coppice {

namespace {

Features features_for(const CollapseMesh& mesh, const EndPointOptions& options, const Watch& watch) {
    Features features = find_features(mesh, watch);
    if (options.lock_sharp_borders) lock_sharp_borders(mesh, features);
    return features;
}

}  // namespace

EndPointCollapse::EndPointCollapse(const Mesh& source, const Target& target, const EndPointOptions& options,
                                   const Watch& watch)
    : source_(source),
      target_(target),
      max_geometric_error_(options.max_geometric_error),
      mesh_(source, watch),
      features_(features_for(mesh_, options, watch)),
      clouds_(mesh_, source, options.scales, watch),
      errors_(mesh_, features_.edges, clouds_, options.weights, InstanceMetric(options.instances), watch),
      rules_(mesh_, features_.kinds, watch),
      bounds_(mesh_, bounds_tolerance_of_diagonal * mesh_.box().diagonal()),
      lines_(mesh_, features_, line_tolerance_of_diagonal * mesh_.box().diagonal()),
      uvs_(mesh_, source, watch),
      deviation_(mesh_),
      wedge_map_(mesh_, clouds_),
      around_(mesh_.vertex_count()),
      count_(target, mesh_) {
    watch.check();
}

std::optional<double> EndPointCollapse::cost_around(uint32_t removed, uint32_t kept) {
    if (!rules_.kinds_allow(removed, kept, around_) || !wedge_map_.find(removed, kept)) {
        ++refusals_[static_cast<size_t>(Refusal::locked)];
        return {};
    }
    const UnifiedError::Cost cost = errors_.cost(removed, kept, wedge_map_.wedges());
    if (max_geometric_error_ && cost.geometric > *max_geometric_error_) {
        ++beyond_max_geometric_error_;
        return {};
    }
    return cost.unified;
}

std::optional<double> EndPointCollapse::cost(uint32_t removed, uint32_t kept) {
    if (rules_.reads_neighbours(removed)) around_.gather(mesh_, removed);
    return cost_around(removed, kept);
}

Candidate EndPointCollapse::next_candidate(uint32_t removed, std::optional<Candidate> after) {
    if (mesh_.valence(removed) > largest_removable_valence) {
        ++refusals_[static_cast<size_t>(Refusal::locked)];
        return {};
    }
    around_.gather(mesh_, removed);
    Candidate best;
    for (const uint32_t kept : around_.all()) {
        const std::optional<double> error = cost_around(removed, kept);
        if (!error) continue;
        const Candidate candidate = {kept, *error};
        if (after && !(*after < candidate)) continue;
        if (candidate < best) best = candidate;
    }
    return best;
}

Refusal EndPointCollapse::check(uint32_t removed, uint32_t kept) {
    if (!wedge_map_.find(removed, kept)) return Refusal::locked;
    if (!bounds_.may_remove(removed)) return Refusal::bounds;
    if (!lines_.may_remove(removed, kept)) return Refusal::topology;
    if (!uvs_.may_collapse(removed, kept, wedge_map_.wedges())) return Refusal::topology;
    const Refusal refusal = rules_.check(removed, kept);
    if (refusal != Refusal::none) return refusal;
    next_deviation_ = deviation_.after(removed, kept);
    const bool too_far = target_.error_model_units && next_deviation_ > *target_.error_model_units;
    return too_far ? Refusal::error : Refusal::none;
}

Refusal EndPointCollapse::try_collapse(uint32_t removed, uint32_t kept) {
    const Refusal refusal = check(removed, kept);
    if (refusal != Refusal::none) {
        ++refusals_[static_cast<size_t>(refusal)];
        return refusal;
    }
    errors_.merge(removed, kept, wedge_map_.wedges());
    deviation_.merge(kept, next_deviation_);
    bounds_.remove(removed);
    lines_.remove(removed, kept);
    mesh_.collapse(removed, kept, wedge_map_.wedges());
    return Refusal::none;
}

void EndPointCollapse::forget_refusals() {
    refusals_ = {};
    beyond_max_geometric_error_ = 0;
}

// A limit that was set is the reason wherever it stopped anything; else what stopped most.
StopReason EndPointCollapse::reason_for_refusals() const {
    const auto count = [this](Refusal r) { return refusals_[static_cast<size_t>(r)]; };
    if (count(Refusal::error) > 0) return StopReason::error_limit;
    if (beyond_max_geometric_error_ > 0) return StopReason::threshold;
    if (count(Refusal::topology) == 0 && count(Refusal::bounds) == 0) return StopReason::locked;
    return count(Refusal::topology) >= count(Refusal::bounds) ? StopReason::topology : StopReason::bounds;
}

Simplified EndPointCollapse::finish(StopReason reason, const Watch& watch) const {
    return {.mesh = mesh_.extract(source_, watch),
            .error_model_units = deviation_.largest(),
            .certified = false,
            .stop_reason = reason};
}

}  // namespace coppice
