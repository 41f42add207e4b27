#include "core/simplify/attribute_quadric/attribute_quadric.h"

#include <algorithm>
#include <array>
#include <functional>
#include <memory>

#include "core/simplify/attribute_quadric/packed_collapse.h"
#include "core/simplify/edge_collapse.h"
#include "core/simplify/gaps_error.h"
#include "core/simplify/instance_weights.h"
#include "core/simplify/target.h"

namespace coppice {

namespace {

std::span<const Parameter> parameters() {
    static constexpr std::array<std::string_view, 2> qualities = {"fast", "best"};
    using Kind = Parameter::Kind;
    static const std::array<Parameter, 5> list = {{
        {.id = "quality",
         .title = "fast, or best: several times as slow, by small steps that are each measured on the mesh "
                  "as it is",
         .kind = Kind::choice,
         .default_value = "fast",
         .choices = qualities},
        {.id = "normal_weight",
         .title = "how many diagonals off the surface are as bad as one unit off in normals",
         .default_value = 0.01,
         .minimum = 0},
        {.id = "uv_weight",
         .title = "how far off the surface is as bad as a texture that lies as far from its place",
         .default_value = 0.3,
         .minimum = 0},
        {.id = "color_weight",
         .title = "how many diagonals off the surface are as bad as one unit off in colours",
         .default_value = 0.01,
         .minimum = 0},
        {.id = "lock_borders",
         .title = "whether open borders stay as they are",
         .kind = Kind::boolean,
         .default_value = false},
    }};
    return list;
}

// Relative to the mean over three directions: attributes and lines have no instances to weigh them, so how
// many there are and of what size must not tell between them and planes. None where they have no volume.
std::function<double(Vec3d)> relative_weight(std::span<const Transform> instances) {
    const InstanceWeights weights(instances);
    const double mean = (weights({1, 0, 0}) + weights({0, 1, 0}) + weights({0, 0, 1})) / 3;
    if (!(mean > 0)) return {};
    return [weights, mean](Vec3d normal) { return weights(normal) / mean; };
}

// What passes have left, edge by edge.
Simplified finish(const Mesh& mesh, const Target& target, const PackedOptions& options, double error,
                  const Watch& watch) {
    Target rest = target;
    if (rest.error_model_units) *rest.error_model_units = std::max(0.0, *rest.error_model_units - error);
    EdgeCollapse work(
        mesh, rest, {.guards = {.lock_borders = options.lock_borders, .tolerance = 1 - packed_tolerance}},
        [&](const CollapseParts& parts) {
            const PlaneOptions planes = {.instance_weight = options.instance_weight};
            return std::make_unique<GapsError>(parts, planes, watch);
        },
        watch);
    CheapestFirst(work, watch).run();
    Simplified result = work.finish(work.done() ? StopReason::target : work.reason_for_refusals(), watch);
    result.error_model_units += error;
    return result;
}

Simplified simplify(const Mesh& source, std::span<const Transform> instances, const Target& target,
                    const ParameterValues& values, const Watch& watch) {
    watch.check();
    if (is_small_enough(source, target)) return already_smaller(source, watch);
    const bool best = values.text("quality") == "best";
    PackedOptions options = {.weights = {.normal = *values.number("normal_weight"),
                                         .uv = *values.number("uv_weight"),
                                         .color = *values.number("color_weight")},
                             .lock_borders = values.boolean("lock_borders"),
                             .share_of_pass = best ? 0.1 : 1,
                             .measures_anew = best};
    if (!instances.empty()) options.instance_weight = relative_weight(instances);
    Simplified result;
    {
        PackedCollapse work(source, options, watch);
        work.run(target, watch.part(0, 0.9));
        result = {.mesh = work.extract(watch),
                  .error_model_units = work.error_model_units(),
                  .stop_reason = work.is_met(target) ? StopReason::target : StopReason::error_limit};
    }
    if (result.stop_reason != StopReason::target)
        result = finish(result.mesh, target, options, result.error_model_units, watch.part(0.9, 1));
    watch.report(1.0);
    return result;
}

}  // namespace

Algorithm attribute_quadric() {
    return {.id = "attribute-quadric",
            .title = "Quadrics over geometry and attributes, in passes",
            .citation =
                "coppice's own, after M. Garland, P. S. Heckbert 1997, H. Hoppe 1999 and P. Lindstrom, "
                "G. Turk 1998",
            .parameters = parameters(),
            .instance_aware = true,
            .simplify = simplify};
}

}  // namespace coppice
