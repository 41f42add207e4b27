#include "core/simplify/surface_angle.h"

#include "core/base/number.h"
#include "core/simplify/angle_removal.h"

namespace coppice {

namespace {

std::span<const Parameter> parameters() {
    static constexpr std::array<std::string_view, 3> stitches = {"delaunay", "paper", "zigzag"};
    static constexpr std::array<std::string_view, 2> borders = {"keep", "remove"};
    static const std::array<Parameter, 5> list = {{
        angle_parameter("a vertex is removed where the angles between its triangles are larger, 180 being "
                        "flat; found by search unless given, 150 where there is no target"),
        pairs_parameter("adjacent"),
        {.id = "count",
         .title = "how many of these angles have to be larger; all of them where a vertex has fewer",
         .kind = Parameter::Kind::text,
         .default_value = "all",
         .pattern = "all|[1-9][0-9]{0,3}",
         .form = "all, or a number from 1 to 9999"},
        {.id = "stitch",
         .title = "how the hole is filled: delaunay: by triangles as equiangular as they get; paper: as "
                  "printed, overlapping, and without any guard of the surface; zigzag: by a strip",
         .kind = Parameter::Kind::choice,
         .default_value = "delaunay",
         .choices = stitches,
         .unguarded_choice = "paper"},
        {.id = "borders",
         .title = "keep: vertices of borders and seams stay; remove: they may go where these are as straight",
         .kind = Parameter::Kind::choice,
         .default_value = "keep",
         .choices = borders},
    }};
    return list;
}

Stitch stitch_named(std::string_view name) {
    return name == "paper" ? Stitch::paper : name == "zigzag" ? Stitch::zigzag : Stitch::delaunay;
}

Simplified simplify(const Mesh& source, std::span<const Transform>, const Target& target,
                    const ParameterValues& values, const Watch& watch) {
    const std::optional<uint64_t> count = parse_whole_number(values.text("count"));  // else "all"
    return remove_by_angle(source, target,
                           {.angle = values.number("angle"),
                            .all_pairs = values.text("pairs") == "all",
                            .count = count,
                            .stitch = stitch_named(values.text("stitch")),
                            .lines = values.text("borders") == "remove"},
                           watch);
}

}  // namespace

Algorithm surface_angle() {
    return {.id = "surface-angle",
            .title = "Surface angle: vertices go where the surface is flat",
            .citation =
                "H. Li, S. Kim: A novel mesh simplification method based on vertex removal using "
                "surface angle. International Journal of Engineering Research and Technology 12, 2019",
            .parameters = parameters(),
            .keeps_values = true,
            .bytes_per_triangle = 200,
            .simplify = simplify};
}

}  // namespace coppice
