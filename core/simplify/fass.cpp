#include "core/simplify/fass.h"

#include <algorithm>

#include "core/simplify/cluster_parameters.h"
#include "core/simplify/fad.h"
#include "core/simplify/ss.h"
#include "core/simplify/target.h"

namespace coppice {

namespace {

constexpr double usual_radius = 0.8;  // mean edges
constexpr double first_stage = 0.4;   // of the time

std::span<const Parameter> parameters() {
    static const std::array<Parameter, 6> list = {{
        angle_parameter("first stage: a vertex is removed where all angles between its triangles are larger, "
                        "180 being flat; 150 unless given"),
        pairs_parameter("all"),
        area_limit_parameter(),
        length_parameter("radius",
                         "second stage: vertices in a ball of this radius are merged; found by search unless "
                         "given, 0.8 where there is no target"),
        neighborhood_parameter,
        passes_parameter,
    }};
    return list;
}

Simplified simplify(const Mesh& source, std::span<const Transform>, const Target& target,
                    const ParameterValues& values, const Watch& watch) {
    watch.check();
    if (is_small_enough(source, target)) return already_smaller(source, watch);
    AngleOptions options = angle_options_in(values);
    options.angle = options.angle.value_or(default_angle);
    options.rounds = 1;
    Simplified first = remove_by_angle(source, target, options, watch.part(0, first_stage));
    if (first.stop_reason == StopReason::target) {
        watch.report(1.0);
        return first;
    }
    Target rest = target;
    if (rest.error_model_units)
        rest.error_model_units = std::max(0.0, *target.error_model_units - first.error_model_units);
    RoundOptions rounds = {.threshold = threshold_in(source, values.length("radius")),
                           .rounds = rounds_in(values)};
    if (!rounds.threshold && !is_set(target)) rounds.threshold = usual_radius * mean_edge(source);
    Simplified result =
        scan_spheres(first.mesh, rest, neighborhood_in(values), rounds, watch.part(first_stage, 1));
    result.error_model_units += first.error_model_units;
    return result;
}

}  // namespace

Algorithm fass() {
    return {.id = "fass",
            .title =
                "Face angle spherical scanning: vertices go where the surface is flat, others within a "
                "ball merge",
            .citation = li_kim_2020,
            .parameters = parameters(),
            .bytes_per_triangle = 220,
            .simplify = simplify};
}

}  // namespace coppice
