#include "core/simplify/garland_heckbert.h"

#include <array>
#include <memory>

#include "core/simplify/edge_collapse.h"
#include "core/simplify/instances_parameter.h"
#include "core/simplify/mean_edge.h"
#include "core/simplify/plane_error.h"
#include "core/simplify/target.h"

namespace coppice {

namespace {

std::span<const Parameter> parameters() {
    static constexpr std::array<std::string_view, 2> placements = {"optimal", "endpoint"};
    static constexpr std::array<std::string_view, 2> weightings = {"area", "none"};
    using Kind = Parameter::Kind;
    static const std::array<Parameter, 5> list = {{
        instances_parameter(),
        {.id = "placement",
         .title = "where an edge is merged: at the point of least error, or at one of its ends",
         .kind = Kind::choice,
         .default_value = "optimal",
         .choices = placements},
        {.id = "weighting",
         .title = "what a triangle's plane weighs: its area, or 1 as in the paper",
         .kind = Kind::choice,
         .default_value = "area",
         .choices = weightings},
        {.id = "pair_distance",
         .title = "how near vertices of open borders are to each other to be merged without an edge between "
                  "them, which joins parts and closes gaps; 0: only edges are",
         .kind = Kind::length,
         .unit = "mean edges",
         .default_value = 0.0,
         .minimum = 0},
        {.id = "boundary_weight",
         .title = "what a plane that holds a border weighs, times the squared length of the edge",
         .default_value = 10.0,
         .minimum = 0},
    }};
    return list;
}

Simplified simplify(const Mesh& source, std::span<const Transform> /*instances*/, const Target& target,
                    const ParameterValues& values, const Watch& watch) {
    watch.check();
    if (is_small_enough(source, target)) return already_smaller(source, watch);
    const PlaneOptions planes = {.by_area = values.text("weighting") == "area",
                                 .boundary_weight = *values.number("boundary_weight")};
    const CollapseOptions options = {
        .freedom = values.text("placement") == "optimal" ? Freedom::anywhere : Freedom::end_point,
        .pair_distance = values.length("pair_distance")->in(mean_edge(source))};
    EdgeCollapse work(
        source, target, options,
        [&](const CollapseParts& parts) { return std::make_unique<PlaneError>(parts, planes, watch); },
        watch);
    CheapestFirst(work, watch).run();
    watch.report(1.0);
    return work.finish(work.done() ? StopReason::target : work.reason_for_refusals(), watch);
}

}  // namespace

Algorithm quadric() {
    return {
        .id = "quadric",
        .title = "Quadric error metrics",
        .citation =
            "M. Garland, P. S. Heckbert: Surface simplification using quadric error metrics. SIGGRAPH 1997",
        .parameters = parameters(),
        .simplify = simplify};
}

}  // namespace coppice
