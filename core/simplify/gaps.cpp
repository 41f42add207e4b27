#include "core/simplify/gaps.h"

#include <array>
#include <memory>

#include "core/simplify/edge_collapse.h"
#include "core/simplify/gaps_error.h"
#include "core/simplify/instances_parameter.h"
#include "core/simplify/scale_parameters.h"
#include "core/simplify/target.h"

namespace coppice {

namespace {

std::span<const Parameter> parameters() {
    static const std::array<Parameter, 4> list = {
        {instances_parameter(), normal_scale_parameter(), uv_scale_parameter(), color_scale_parameter()}};
    return list;
}

Simplified simplify(const Mesh& source, std::span<const Transform> /*instances*/, const Target& target,
                    const ParameterValues& values, const Watch& watch) {
    watch.check();
    if (is_small_enough(source, target)) return already_smaller(source, watch);
    EdgeCollapse work(
        source, target, {.scales = attribute_scales(values)},
        [&](const CollapseParts& parts) { return std::make_unique<GapsError>(parts, PlaneOptions{}, watch); },
        watch);
    CheapestFirst(work, watch).run();
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
