#include "core/simplify/gaps.h"

#include <array>
#include <limits>
#include <memory>

#include "core/simplify/edge_collapse.h"
#include "core/simplify/gaps_error.h"
#include "core/simplify/instances_parameter.h"
#include "core/simplify/mean_edge.h"
#include "core/simplify/scale_parameters.h"
#include "core/simplify/target.h"

namespace coppice {

namespace {

std::span<const Parameter> parameters() {
    static const std::array<Parameter, 6> list = {{
        instances_parameter(),
        {.id = "pair_distance",
         .title = "how near vertices of open borders are to each other to be merged without an edge between "
                  "them, which joins parts and closes gaps: at first; it doubles whenever no merge is left "
                  "whose error is less; 0: only edges are merged",
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

// As long as merges are left whose error is less than the pair distance, those come first; then it doubles,
// until it is as large as the mesh.
void run(EdgeCollapse& work, double pair_distance, const Watch& watch) {
    CheapestFirst order(work, watch);
    if (!work.has_pairs()) return order.run();
    order.queue_all();
    const double diagonal = work.mesh().box().diagonal();
    for (double distance = pair_distance;; distance *= 2) {
        const bool is_last = !(distance < diagonal);
        order.drain(is_last ? std::numeric_limits<double>::infinity() : distance);
        if (order.empty()) order.run();
        if (work.done() || is_last) break;
        work.set_pair_distance(2 * distance, watch);
        for (uint32_t v = 0; v < work.mesh().vertex_count(); ++v)
            if (work.is_paired(v)) order.queue_again(v);
    }
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
    run(work, pair_distance, watch);
    watch.report(1.0);
    return work.finish(work.done() ? StopReason::target : work.reason_for_refusals(), watch);
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
