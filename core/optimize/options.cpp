#include "core/optimize/options.h"

#include <array>
#include <cmath>
#include <string_view>

#include "core/base/error.h"
#include "core/optimize/plan.h"
#include "core/simplify/registry.h"

namespace coppice {

namespace {

// A parameter that means something with one choice of another alone, or with a switch that is on.
struct OfMode {
    std::string_view algorithm, parameter, choice, value;
};
constexpr std::array of_modes = {
    OfMode{"its", "threshold", "mode", "faithful"}, OfMode{"gaea", "n", "schema", "uniform"},
    OfMode{"gaea", "xyz", "schema", "xyz"}, OfMode{"gaea", "codebook_size", "schema", "xyz"},
    OfMode{"ias", "seed", "prune_instances", "true"}};

std::string_view chosen(const ParameterValues& values, std::string_view id) {
    const auto found = values.all().find(id);
    if (found == values.all().end() || !std::holds_alternative<bool>(found->second)) return values.text(id);
    return values.boolean(id) ? "true" : "false";
}

void check_modes(const Algorithm& algorithm, const ParameterValues& values, const OptimizeOptions& options) {
    for (const OfMode& rule : of_modes) {
        const bool is_idle = algorithm.id == rule.algorithm && chosen(values, rule.choice) != rule.value &&
                             options.parameters.contains(std::string(rule.parameter));
        require(!is_idle, ErrorCode::option_conflict, fmt::format("parameters.{}", rule.parameter),
                "parameters.{} belongs to parameters.{}={}, and the {} is {}", rule.parameter, rule.choice,
                rule.value, rule.choice, chosen(values, rule.choice));
    }
    const std::optional<Length> pair_distance = values.length("pair_distance");
    require(!options.parameters.contains("area_tolerance") || pair_distance->value > 0,
            ErrorCode::option_conflict, "parameters.area_tolerance",
            "parameters.area_tolerance belongs to a parameters.pair_distance over 0, and it is 0");
    const bool names_two = values.all().contains("xyz") && values.all().contains("codebook_size");
    require(
        !names_two, ErrorCode::option_conflict, "parameters.codebook_size",
        "parameters.xyz and parameters.codebook_size exclude each other: give the one that is the codebook");
    require(
        !values.boolean("prune_instances") || (!options.triangles && !options.error),
        ErrorCode::option_conflict, "parameters.prune_instances",
        "parameters.prune_instances drops what is drawn to meet ratio: a target in stored triangles and a "
        "limit of the error exclude it");
}

}  // namespace

void check_output(Format format, Instancing instancing) {
    require(is_writable(format), ErrorCode::option_invalid, "format",
            "format {} can be read but not written; format takes glb, gltf, obj or iobj", id(format));
    const bool possible = [&] {
        switch (format) {
            case Format::obj:
                return instancing == Instancing::automatic || instancing == Instancing::expand;
            case Format::iobj:
                return instancing == Instancing::automatic || instancing == Instancing::nodes;
            default:
                return true;
        }
    }();
    require(possible, ErrorCode::option_conflict, "instancing",
            "with format {} instancing is auto or {}; glb and gltf take every kind", id(format),
            format == Format::obj ? "expand" : "nodes");
}

void validate(const OptimizeOptions& options) {
    const Algorithm& algorithm =
        options.algorithm.empty() ? default_algorithm() : find_algorithm(options.algorithm);
    const ParameterValues parameters = ParameterValues::parse(algorithm.parameters, options.parameters);
    check_modes(algorithm, parameters, options);

    const auto ratio = options.ratio.value_or(1);
    require(ratio > 0 && ratio <= 1, ErrorCode::option_invalid, "ratio",
            "ratio is {}; it takes a number over 0 and at most 1", ratio);
    require(options.triangles.value_or(1) >= 1, ErrorCode::option_invalid, "triangles",
            "triangles is 0; it takes a whole number of at least 1");
    const auto error = options.error.value_or(1);
    require(std::isfinite(error) && error > 0, ErrorCode::option_invalid, "error",
            "error is {}; it takes a number over 0, as a fraction of the scene's diagonal", error);
    require(!options.ratio || !options.triangles, ErrorCode::option_conflict, "triangles",
            "ratio and triangles exclude each other: give the one that is the target");
    require(!options.triangles || parameters.text("stop") != "vertices", ErrorCode::option_conflict,
            "triangles",
            "with parameters.stop=vertices the target is ratio, which then counts vertices, not triangles");
    if (options.format) check_output(*options.format, options.instancing);
}

}  // namespace coppice
