#include "core/simplify/vt.h"

#include <algorithm>

#include "core/simplify/cluster_parameters.h"
#include "core/simplify/triangle_merges.h"

namespace coppice {

namespace {

uint32_t decide(const std::array<double, 3>& edges, double threshold) {
    return std::max({edges[0], edges[1], edges[2]}) <= threshold ? 7 : 0;
}

std::span<const Parameter> parameters() {
    static const std::array<Parameter, 3> list = {{
        length_parameter("max_edge",
                         "triangles with a longer edge are not merged; found by search unless given"),
        passes_parameter,
        circumcenter_parameter,
    }};
    return list;
}

Simplified simplify(const Mesh& source, std::span<const Transform>, const Target& target,
                    const ParameterValues& values, const Watch& watch) {
    const bool paper = values.text("circumcenter") == "paper";
    return simplify_by_triangles(
        source, target,
        {.decide = decide,
         .circumcentre = paper ? Circumcentre::paper : Circumcentre::clamp,
         .as_printed = paper},
        {.threshold = threshold_in(source, values.length("max_edge")), .rounds = rounds_in(values)}, watch);
}

}  // namespace

Algorithm vt() {
    return {.id = "vt",
            .title = "Vertex triplex: triangles merge at their circumcentres",
            .citation = li_kim_2020,
            .parameters = parameters(),
            .bytes_per_triangle = 220,
            .simplify = simplify};
}

}  // namespace coppice
