#include "core/simplify/end_point_collapse.h"

#include <algorithm>

namespace coppice {

namespace {

// The box may lose 1 % of its diagonal; rounding in writers needs a little of that.
constexpr double bounds_tolerance_of_diagonal = 0.009;
// Borders and seams may move by 5 %, likewise.
constexpr double line_tolerance_of_diagonal = 0.049;

double way(uint32_t first, uint32_t now, std::optional<uint64_t> target) {
    if (!target || *target >= first) return target ? 1.0 : 0.0;
    return static_cast<double>(first - now) / static_cast<double>(first - *target);
}

Features features_for(const CollapseMesh& mesh, const EndPointOptions& options, const Watch& watch) {
    Features features = find_features(mesh, watch);
    if (options.lock_sharp_borders) lock_sharp_borders(mesh, features);
    return features;
}

}  // namespace

EndPointCollapse::EndPointCollapse(const Mesh& source, const Target& target, const EndPointOptions& options,
                                   const Watch& watch)
    : steps_(watch),
      source_(source),
      target_(target),
      max_geometric_error_(options.max_geometric_error),
      mesh_(source, watch),
      features_(features_for(mesh_, options, watch)),
      clouds_(mesh_, source, options.scales, watch),
      errors_(mesh_, features_.edges, clouds_, options.weights, InstanceMetric(options.instances), watch),
      rules_(mesh_, features_.kinds, watch),
      bounds_(mesh_, bounds_tolerance_of_diagonal * mesh_.box().diagonal(), watch),
      lines_(mesh_, features_, line_tolerance_of_diagonal * mesh_.box().diagonal(), watch),
      uvs_(mesh_, source, watch),
      deviation_(mesh_, watch),
      wedge_map_(mesh_, clouds_),
      around_(mesh_.vertex_count(), watch),
      first_triangles_(mesh_.live_triangles()),
      first_vertices_(mesh_.live_vertices()) {
    watch.check();
}

bool EndPointCollapse::done() const {
    if (target_.triangles && mesh_.live_triangles() <= *target_.triangles) return true;
    return target_.vertices && mesh_.live_vertices() <= *target_.vertices;
}

double EndPointCollapse::fraction() const {
    const double by_triangles = way(first_triangles_, mesh_.live_triangles(), target_.triangles);
    const double by_vertices = way(first_vertices_, mesh_.live_vertices(), target_.vertices);
    const double by_removal = first_triangles_ > 0 ? way(first_triangles_, mesh_.live_triangles(), 0) : 1.0;
    return std::clamp(std::max({by_triangles, by_vertices, by_removal}), 0.0, 1.0);
}

std::optional<double> EndPointCollapse::cost_around(uint32_t removed, uint32_t kept) {
    steps_.add(mesh_.valence(removed));
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
    const uint64_t searched = rules_.searched();
    const Refusal refusal = check(removed, kept);
    steps_.add(size_t{8} * mesh_.valence(removed) + (rules_.searched() - searched));  // each rule looks again
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
