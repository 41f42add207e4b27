// What the descriptions of the clustering algorithms have in common.
#pragma once

#include <array>
#include <optional>
#include <string_view>

#include "core/simplify/mean_edge.h"
#include "core/simplify/parameter.h"

namespace coppice {

inline constexpr std::string_view li_kim_2020 =
    "H. Li, S. Kim: Mesh simplification algorithms for rendering performance. International Journal of "
    "Engineering Research and Technology 13, 2020";

inline constexpr std::array<std::string_view, 2> circumcenters = {"clamp", "paper"};
inline const Parameter circumcenter_parameter = {
    .id = "circumcenter",
    .title =
        "where an obtuse triangle merges: clamp: inside it; paper: as printed, outside, and then without "
        "any guard of the surface",
    .kind = Parameter::Kind::choice,
    .default_value = "clamp",
    .choices = circumcenters,
    .unguarded_choice = "paper"};

inline const Parameter passes_parameter = {
    .id = "passes",
    .title = "rounds over what the one before left; unless given, one, or as many as a target takes",
    .kind = Parameter::Kind::integer,
    .minimum = 1,
    .maximum = 16,
    .ends_run = true};

inline constexpr std::array<std::string_view, 2> neighborhoods = {"connected", "euclidean"};
inline const Parameter neighborhood_parameter = {
    .id = "neighborhood",
    .title =
        "connected: what edges connect to the ball's centre; euclidean: all that is in the ball, without "
        "any guard of the surface",
    .kind = Parameter::Kind::choice,
    .default_value = "connected",
    .choices = neighborhoods,
    .unguarded_choice = "euclidean"};

inline Parameter length_parameter(std::string_view id, std::string_view title) {
    return {.id = id,
            .title = title,
            .kind = Parameter::Kind::length,
            .unit = "mean edges",
            .minimum = 0,
            .minimum_excluded = true,
            .ends_run = true};
}

inline std::optional<double> threshold_in(const Mesh& mesh, std::optional<Length> length) {
    return length ? std::optional(length->in(mean_edge(mesh))) : std::nullopt;
}

inline std::optional<uint32_t> rounds_in(const ParameterValues& values) {
    const std::optional<double> passes = values.number("passes");
    return passes ? std::optional(static_cast<uint32_t>(*passes)) : std::nullopt;
}

}  // namespace coppice
