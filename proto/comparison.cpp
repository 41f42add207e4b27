#include "proto/comparison.h"

#include <nlohmann/json.hpp>
#include <optional>

#include "core/optimize/engine.h"
#include "proto/asset_json.h"
#include "proto/json.h"

namespace coppice {
namespace {

using Json = nlohmann::ordered_json;

template <typename T, typename Print>
Json or_null(const std::optional<T>& value, Print print) {
    return value ? print(*value) : Json(nullptr);
}

// diagonal: of the reference; 0 where the lengths are those of a single mesh, which say no fraction.
Json distance(const Spread& spread, double diagonal) {
    Json json = {{"largest_model_units", spread.largest},
                 {"mean_model_units", spread.mean},
                 {"rms_model_units", spread.root_mean_square}};
    if (!(diagonal > 0)) return json;
    json["largest_diagonal_fraction"] = spread.largest / diagonal;
    json["mean_diagonal_fraction"] = spread.mean / diagonal;
    json["rms_diagonal_fraction"] = spread.root_mean_square / diagonal;
    return json;
}

Json angles(const AngleSpread& spread) {
    return {{"largest_degrees", spread.largest},
            {"mean_degrees", spread.mean},
            {"percentile_95_degrees", spread.percentile_95}};
}

Json texture(const SurfaceComparison& surface) {
    if (!surface.texture || !surface.texture_model_units) return nullptr;
    return {{"largest_texture_units", surface.texture->largest},
            {"mean_texture_units", surface.texture->mean},
            {"rms_texture_units", surface.texture->root_mean_square},
            {"largest_model_units", surface.texture_model_units->largest},
            {"mean_model_units", surface.texture_model_units->mean},
            {"rms_model_units", surface.texture_model_units->root_mean_square}};
}

Json colors(const Spread& spread) {
    return {{"largest", spread.largest}, {"mean", spread.mean}, {"rms", spread.root_mean_square}};
}

Json to_json(const SurfaceComparison& surface, double diagonal) {
    Json json;
    json["surface_distance"] = {
        {"symmetric", distance(surface.symmetric, diagonal)},
        {"reference_to_candidate", distance(surface.reference_to_candidate, diagonal)},
        {"candidate_to_reference", distance(surface.candidate_to_reference, diagonal)}};
    json["normal_deviation"] = or_null(surface.normals, angles);
    json["facet_normal_deviation"] = or_null(surface.facets, angles);
    json["texture_coordinate_deviation"] = texture(surface);
    json["color_deviation"] = or_null(surface.colors, colors);
    json["flipped_triangles"] = surface.flips.triangles;
    json["flipped_texture_triangles"] = surface.flips.texture_triangles;
    return json;
}

Json elements(const SceneElements& of_scene) {
    const Elements& e = of_scene.elements;
    Json json = {{"triangles", e.triangles},
                 {"vertices", e.vertices},
                 {"degenerate_triangles", e.degenerate_triangles},
                 {"duplicate_triangles", e.duplicate_triangles},
                 {"non_manifold_edges", e.non_manifold_edges},
                 {"inconsistent_edges", e.inconsistent_edges},
                 {"border_edges", e.border_edges},
                 {"border_length_model_units", e.border_length},
                 {"components", e.components},
                 {"euler_number", e.euler_number},
                 {"area_square_model_units", e.area},
                 {"volume_cubic_model_units", e.volume},
                 {"smallest_angle_degrees", e.smallest_angle}};
    json["self_intersections"] =
        or_null(of_scene.self_intersections, [](const SelfIntersections& found) -> Json {
            return {{"pairs", found.pairs}, {"triangles", found.triangles}};
        });
    return json;
}

Json mesh(const MeshComparison& compared) {
    return {{"name", compared.name},
            {"instances", compared.instances},
            {"largest_scale", compared.largest_scale},
            {"surface", to_json(compared.surface, 0)}};
}

}  // namespace

std::string print_comparison(const Comparison& comparison) {
    const SceneComparison& scenes = comparison.scenes;
    Json json = {{"reference", to_json(comparison.reference)}, {"candidate", to_json(comparison.candidate)}};
    json["measured"] = scenes.is_by_mesh ? "meshes" : "expanded";
    json["diagonal_model_units"] = scenes.diagonal;
    json["surface"] = to_json(scenes.surface, scenes.diagonal);
    json["elements"] = {{"reference", elements(scenes.reference)}, {"candidate", elements(scenes.candidate)}};
    json["meshes"] = Json::array();
    for (const MeshComparison& compared : scenes.meshes) json["meshes"].push_back(mesh(compared));
    json["warnings"] = Json::array();
    for (const Warning& warning : comparison.warnings) json["warnings"].push_back(to_json(warning));
    json["engine"] = {{"version", engine_version()}, {"build", engine_build()}};
    return print_json(json);
}

}  // namespace coppice
