#include "core/simplify/ivdd.h"

#include "core/simplify/cluster_parameters.h"
#include "core/simplify/triangle_merges.h"

namespace coppice {

namespace {

// Bits 1, 2, 4 for the corners; edge k goes from corner k to the next.
uint32_t decide(const std::array<double, 3>& edges, double threshold) {
    const std::array<uint32_t, 3> ends = {3, 6, 5};
    uint32_t bits = 0;
    for (size_t k = 0; k < 3; ++k) bits |= edges[k] < threshold ? ends[k] : 0;
    return bits;
}

std::span<const Parameter> parameters() {
    static constexpr std::array<std::string_view, 2> modes = {"once", "sequential"};
    static const std::array<Parameter, 3> list = {{
        length_parameter("distance",
                         "vertices of a triangle that are nearer are merged; found by search unless given"),
        {.id = "mode",
         .title = "once: a vertex is merged once in a round; sequential: as often as triangles say, without "
                  "any guard of the surface",
         .kind = Parameter::Kind::choice,
         .default_value = "once",
         .choices = modes,
         .unguarded_choice = "sequential"},
        circumcenter_parameter,
    }};
    return list;
}

Simplified simplify(const Mesh& source, std::span<const Transform>, const Target& target,
                    const ParameterValues& values, const Watch& watch) {
    const bool paper = values.text("circumcenter") == "paper";
    const bool sequential = values.text("mode") == "sequential";
    return simplify_by_triangles(source, target,
                                 {.decide = decide,
                                  .circumcentre = paper ? Circumcentre::paper : Circumcentre::clamp,
                                  .as_printed = paper || sequential,
                                  .sequential = sequential},
                                 {.threshold = threshold_in(source, values.length("distance"))}, watch);
}

}  // namespace

Algorithm ivdd() {
    return {.id = "ivdd",
            .title = "Intervertex distance dependence: near vertices of triangles merge",
            .citation = li_kim_2020,
            .parameters = parameters(),
            .bytes_per_triangle = 220,
            .simplify = simplify};
}

}  // namespace coppice
