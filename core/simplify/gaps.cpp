#include "core/simplify/gaps.h"

#include <algorithm>
#include <array>
#include <memory>

#include "core/simplify/edge_collapse.h"
#include "core/simplify/gaps_error.h"
#include "core/simplify/instances_parameter.h"
#include "core/simplify/mean_edge.h"
#include "core/simplify/scale_parameters.h"
#include "core/simplify/target.h"

namespace coppice {

namespace {

// Doubling from less would only take time.
constexpr double least_distance_of_diagonal = 1e-6;

std::span<const Parameter> parameters() {
    static const std::array<Parameter, 6> list = {{
        instances_parameter(),
        {.id = "pair_distance",
         .title = "how near vertices of open borders are to each other to be merged without an edge between "
                  "them, which joins parts and closes gaps; it doubles whenever nothing is left to merge; 0: "
                  "only edges are merged",
         .kind = Parameter::Kind::length,
         .unit = "mean edges",
         .default_value = 0.25,
         .minimum = 0},
        {.id = "area_tolerance",
         .title = "by which part of itself the area around vertices without an edge between them may change "
                  "when they are merged",
         .default_value = 0.5,
         .minimum = 0},
        normal_scale_parameter(),
        uv_scale_parameter(),
        color_scale_parameter(),
    }};
    return list;
}

Simplified finished(const EdgeCollapse& work, const Watch& watch) {
    return work.finish(work.done() ? StopReason::target : work.reason_for_refusals(), watch);
}

// The pair distance doubles while nothing else is left, and while that pays. Ends that are farther apart than
// twice what lines may move are never joined, nor those that the error parts. Joins alone save no triangle:
// where none goes and no vertices are wanted, the result is what was there before.
Simplified run(EdgeCollapse& work, double pair_distance, const Target& target, const Watch& watch) {
    CheapestFirst order(work, watch);
    order.run();
    Simplified best = finished(work, watch);
    const CollapseMesh& mesh = work.mesh();
    const double diagonal = mesh.box().diagonal();
    const double farthest =
        2 * std::min(line_tolerance_of_diagonal * diagonal, target.error_model_units.value_or(diagonal));
    double distance = std::max(pair_distance, least_distance_of_diagonal * diagonal);
    while (work.has_pairs() && !work.done() && distance < farthest) {
        distance *= 2;
        work.set_pair_distance(distance, watch);
        for (uint32_t v = 0; v < mesh.vertex_count(); ++v)
            if (work.is_paired(v)) order.queue_again(v);
        if (order.empty()) continue;  // none are so near
        const uint32_t before = mesh.live_triangles();
        order.drain();
        if (work.done() || mesh.live_triangles() < best.mesh.triangle_count()) best = finished(work, watch);
        if (before - mesh.live_triangles() < before / 50) break;
    }
    return best;
}

Simplified simplify(const Mesh& source, std::span<const Transform> /*instances*/, const Target& target,
                    const ParameterValues& values, const Watch& watch) {
    watch.check();
    if (is_small_enough(source, target)) return already_smaller(source, watch);
    const double pair_distance = values.length("pair_distance")->in(mean_edge(source));
    EdgeCollapse work(
        source, target,
        {.scales = attribute_scales(values),
         .pair_distance = pair_distance,
         .area_tolerance = values.number("area_tolerance")},
        [&](const CollapseParts& parts) { return std::make_unique<GapsError>(parts, PlaneOptions{}, watch); },
        watch);
    Simplified result = run(work, pair_distance, target, watch);
    watch.report(1.0);
    return result;
}

}  // namespace

Algorithm gaps() {
    return {
        .id = "gaps",
        .title = "General and automatic polygonal simplification",
        .citation = "C. Erikson, D. Manocha: GAPS: General and automatic polygonal simplification. I3D 1999",
        .parameters = parameters(),
        .simplify = simplify};
}

}  // namespace coppice
