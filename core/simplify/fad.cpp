#include "core/simplify/fad.h"

#include "core/simplify/cluster_parameters.h"

namespace coppice {

namespace {

constexpr uint32_t until_nothing_is_left = 1000;

std::span<const Parameter> parameters() {
    static const std::array<Parameter, 3> list = {{
        angle_parameter("a vertex is removed where all angles between its triangles are larger, 180 being "
                        "flat; found by search unless given, 150 where there is no target"),
        pairs_parameter("all"),
        area_limit_parameter(),
    }};
    return list;
}

Simplified simplify(const Mesh& source, std::span<const Transform>, const Target& target,
                    const ParameterValues& values, const Watch& watch) {
    AngleOptions options = angle_options_in(values);
    if (!target.triangles && !target.vertices && options.angle) options.rounds = until_nothing_is_left;
    return remove_by_angle(source, target, options, watch);
}

}  // namespace

Parameter area_limit_parameter() {
    return {.id = "area_limit",
            .title = "vertices whose triangles have a larger area stay; none unless given",
            .kind = Parameter::Kind::number,
            .unit = "mean ring areas",
            .minimum = 0,
            .minimum_excluded = true};
}

AngleOptions angle_options_in(const ParameterValues& values) {
    return {.angle = values.number("angle"),
            .all_pairs = values.text("pairs") == "all",
            .area_limit = values.number("area_limit"),
            .lines = true};
}

Algorithm fad() {
    return {.id = "fad",
            .title = "Face angle dependency: vertices go where the surface is flat and finely divided",
            .citation = li_kim_2020,
            .parameters = parameters(),
            .keeps_values = true,
            .bytes_per_triangle = 200,
            .simplify = simplify};
}

}  // namespace coppice
