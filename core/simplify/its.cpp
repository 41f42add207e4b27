#include "core/simplify/its.h"

#include <array>
#include <string>

#include "core/simplify/end_point_collapse.h"
#include "core/simplify/its_order.h"
#include "core/simplify/target.h"

namespace coppice {

namespace {

std::span<const Parameter> parameters() {
    static constexpr std::array<std::string_view, 2> modes = {"full", "faithful"};
    static constexpr std::array<std::string_view, 2> stops = {"triangles", "vertices"};
    using Kind = Parameter::Kind;
    static const std::array<Parameter, 7> list = {{
        {.id = "mode",
         .title = "full ranks all edges by error; faithful only those under the paper's threshold",
         .kind = Kind::choice,
         .default_value = "full",
         .choices = modes},
        {.id = "stop",
         .title = "what ratio counts",
         .kind = Kind::choice,
         .default_value = "triangles",
         .choices = stops},
        {.id = "threshold",
         .title = "mode=faithful: the first threshold t for the length of edges; a quarter of the mean edge "
                  "unless given",
         .unit = "mesh units",
         .minimum = 0,
         .minimum_excluded = true},
        {.id = "normal_scale",
         .title = "what one unit of normals weighs; 0.05 of the mesh's diagonal unless given",
         .unit = "mesh units",
         .minimum = 0},
        {.id = "uv_scale",
         .title =
             "what one unit of texture coordinates weighs; sqrt(area / area in the texture) unless given",
         .unit = "mesh units",
         .minimum = 0},
        {.id = "color_scale",
         .title = "what one unit of colours weighs; 0.05 of the mesh's diagonal unless given",
         .unit = "mesh units",
         .minimum = 0},
        {.id = "max_geometric_error",
         .title =
             "edges whose geometric error is larger, in the proportions that instances give the mesh, are "
             "not collapsed; none unless given",
         .unit = "mesh units",
         .minimum = 0,
         .ends_run = true},
    }};
    return list;
}

Simplified simplify(const Mesh& source, std::span<const Transform> instances, const Target& target,
                    const ParameterValues& values, const Watch& watch) {
    watch.check();
    if (is_small_enough(source, target)) return already_smaller(source, watch);
    const bool faithful = values.choice("mode") == "faithful";
    const EndPointOptions options = {
        .weights = faithful ? PlaneWeights::count : PlaneWeights::area,
        .scales = {values.number("normal_scale"), values.number("uv_scale"), values.number("color_scale")},
        .lock_sharp_borders = faithful,  // full has planes that hold them
        .instances = instances,
        .max_geometric_error = values.number("max_geometric_error"),
    };
    EndPointCollapse work(source, target, options, watch);
    if (faithful) {
        collapse_under_threshold(work, values.number("threshold"), watch);
    } else {
        collapse_cheapest_first(work, watch);
    }
    watch.report(1.0);
    return work.finish(work.done() ? StopReason::target : work.reason_for_refusals(), watch);
}

}  // namespace

Algorithm its() {
    return {.id = "its",
            .title = "Instanced simplification by geometry and appearance",
            .citation =
                "S. Tariq, A. U. Rahman, T. Azim, R. G. Khan: Instanced model simplification using combined "
                "geometric "
                "and appearance-related metric. arXiv:2101.02570, 2021",
            .parameters = parameters(),
            .instance_aware = true,
            .keeps_values = true,
            .simplify = simplify};
}

}  // namespace coppice
