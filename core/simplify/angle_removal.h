// Rounds of removals of the vertices around which the surface is flat enough: what surface-angle and fad do.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string_view>

#include "core/simplify/algorithm.h"
#include "core/simplify/vertex_removal.h"

namespace coppice {

// Angles are included ones, in degrees: 180 where two triangles lie in a plane.
inline constexpr double default_angle = 150;

inline constexpr std::array<std::string_view, 2> pairs_of_triangles = {"adjacent", "all"};

inline Parameter angle_parameter(std::string_view title) {
    return {.id = "angle",
            .title = title,
            .kind = Parameter::Kind::number,
            .unit = "degrees",
            .minimum = 0,
            .maximum = 180,
            .ends_run = true};
}

inline Parameter pairs_parameter(std::string_view default_value) {
    return {.id = "pairs",
            .title = "between which triangles at a vertex: adjacent: those that share an edge; all: any two",
            .kind = Parameter::Kind::choice,
            .default_value = std::string(default_value),
            .choices = pairs_of_triangles};
}

struct AngleOptions {
    std::optional<double> angle =
        {};                  // a vertex goes where the angles at it are larger; none: found by search
    bool all_pairs = false;  // between any two of its triangles, else only where they share an edge
    std::optional<uint64_t> count = {};     // how many of the angles must be larger; none: all
    std::optional<double> area_limit = {};  // of its triangles, in means over all vertices; larger ones stay
    Stitch stitch = Stitch::delaunay;
    bool lines = false;  // borders and seams lose vertices too, where they turn by less than 180 - angle
    std::optional<uint32_t> rounds = {};
};

// A round decides by the mesh as it is at its start, takes vertices by number, and leaves those around a
// removed one alone. Where three creases or more meet (sharper than 150 degrees) their angles count together,
// so that a corner stays longer than its edges; not so in the paper's stitch, nor where `count` is given. An
// angle alone: `rounds`, or one. With a target, rounds at the largest angles that meet it (cluster_rounds.h),
// never below `angle`. threshold_used is the least angle of a round.
Simplified remove_by_angle(const Mesh& source, const Target& target, const AngleOptions& options,
                           const Watch& watch);

}  // namespace coppice
