#include "core/simplify/its.h"

#include <array>
#include <memory>
#include <string>

#include "core/simplify/edge_collapse.h"
#include "core/simplify/its_faithful.h"
#include "core/simplify/scale_parameters.h"
#include "core/simplify/target.h"
#include "core/simplify/unified_error.h"

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
        normal_scale_parameter(),
        uv_scale_parameter(),
        color_scale_parameter(),
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
    const bool faithful = values.text("mode") == "faithful";
    const CollapseOptions options = {
        .freedom = Freedom::end_point,
        .scales = attribute_scales(values),
        .guards = {.lock_sharp_borders = faithful}};  // full has planes that hold them
    const UnifiedOptions error = {.weights = faithful ? PlaneWeights::count : PlaneWeights::area,
                                  .instances = instances,
                                  .max_geometric_error = values.number("max_geometric_error")};
    EdgeCollapse work(
        source, target, options,
        [&](const CollapseParts& parts) { return std::make_unique<UnifiedError>(parts, error, watch); },
        watch);
    if (faithful) {
        collapse_under_threshold(work, values.number("threshold"), watch);
    } else {
        CheapestFirst(work, watch).run();
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
            .bytes_per_triangle = 320,
            .simplify = simplify};
}

}  // namespace coppice
