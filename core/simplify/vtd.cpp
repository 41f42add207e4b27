#include "core/simplify/vtd.h"

#include <algorithm>

#include "core/simplify/cluster_parameters.h"
#include "core/simplify/triangle_merges.h"

namespace coppice {

namespace {

// Bits 1, 2, 4 for the corners; edge k goes from corner k to the next.
constexpr std::array<uint32_t, 3> ends = {3, 6, 5};
constexpr uint32_t all = 7;

bool all_shorter(const std::array<double, 3>& edges, double threshold) {
    return std::all_of(edges.begin(), edges.end(), [=](double e) { return e < threshold; });
}

uint32_t decide_short(const std::array<double, 3>& edges, double threshold) {
    if (all_shorter(edges, threshold)) return all;
    const auto shortest = std::min_element(edges.begin(), edges.end());
    return *shortest <= threshold ? ends[static_cast<size_t>(shortest - edges.begin())] : 0;
}

uint32_t decide_as_printed(const std::array<double, 3>& edges, double threshold) {
    if (all_shorter(edges, threshold)) return all;
    for (const size_t k : {0U, 2U, 1U}) {  // 12, 13, 23 of the paper
        if (edges[k] > threshold) continue;
        const size_t a = (k + 1) % 3, b = (k + 2) % 3;
        const size_t longer = edges[a] > edges[b] ? a : b;
        if (edges[longer] <= 2 * threshold) return ends[longer];
    }
    return 0;
}

std::span<const Parameter> parameters() {
    static constexpr std::array<std::string_view, 2> rules = {"short", "paper"};
    static const std::array<Parameter, 3> list = {{
        length_parameter("distance",
                         "vertices of a triangle that are nearer are merged; found by search unless given"),
        {.id = "rule",
         .title = "short: where not all three are near the shortest edge goes; paper: the longer one beside "
                  "a short one, as printed, without any guard of the surface",
         .kind = Parameter::Kind::choice,
         .default_value = "short",
         .choices = rules,
         .unguarded_choice = "paper"},
        circumcenter_parameter,
    }};
    return list;
}

Simplified simplify(const Mesh& source, std::span<const Transform>, const Target& target,
                    const ParameterValues& values, const Watch& watch) {
    const bool paper = values.text("circumcenter") == "paper";
    const bool as_printed = values.text("rule") == "paper";
    return simplify_by_triangles(source, target,
                                 {.decide = as_printed ? decide_as_printed : decide_short,
                                  .circumcentre = paper ? Circumcentre::paper : Circumcentre::clamp,
                                  .as_printed = paper || as_printed},
                                 {.threshold = threshold_in(source, values.length("distance"))}, watch);
}

}  // namespace

Algorithm vtd() {
    return {.id = "vtd",
            .title = "Vertex triplex distance: small triangles and short edges merge",
            .citation = li_kim_2020,
            .parameters = parameters(),
            .bytes_per_triangle = 220,
            .simplify = simplify};
}

}  // namespace coppice
