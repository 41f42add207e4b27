// What a simplification algorithm is: a value in the registry.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

#include "core/base/watch.h"
#include "core/mesh/mesh.h"
#include "core/scene/transform.h"
#include "core/simplify/parameter.h"

namespace coppice {

// Why a run ended. Names as in the report.
enum class StopReason {
    target,
    error_limit,
    threshold,
    topology,
    bounds,
    locked,
    already_smaller,
    cancelled
};
std::string_view name(StopReason reason);

// When to stop; whichever keeps more triangles. At least one is set, unless the algorithm has a threshold of
// its own.
struct Target {
    std::optional<uint64_t> triangles = {};        // stop at or below
    std::optional<uint64_t> vertices = {};         // stop at or below (vertices in use)
    std::optional<double> error_model_units = {};  // stop before the deviation exceeds it
};

struct Simplified {
    Mesh mesh;  // consistent; unused vertices and wedges dropped
    double error_model_units =
        0;  // largest deviation that the algorithm estimates; not a bound unless certified
    bool certified = false;
    StopReason stop_reason = StopReason::target;
    std::optional<double> threshold_used = {};  // of an algorithm that has one, in that parameter's unit
};

// When to stop a whole scene, for algorithms that weigh its meshes against each other.
struct SceneTarget {
    std::optional<uint64_t> triangles = {};  // stop at or below
    bool rendered = true;         // which count as often as they are drawn; else as they are stored
    std::vector<Target> of_mesh;  // limits of each mesh: only the error is set
};

struct SimplifiedScene {
    std::vector<Simplified> meshes;  // in the scene's order
    // Per mesh: which of its instances are not to be drawn any more, ascending. Empty, or one list for each
    // mesh.
    std::vector<std::vector<uint32_t>> dropped_instances = {};
};

struct Algorithm {
    std::string_view id;
    std::string_view title;
    std::string_view citation;
    std::span<const Parameter> parameters;
    bool instance_aware = false;  // the instances of a mesh weigh in what is kept of it
    bool keeps_values = false;    // positions and attributes of the result are some of the mesh's, untouched
    // At most this much memory beside the mesh, its result included, with normals and texture coordinates.
    uint32_t bytes_per_triangle = 400;
    double bounds_tolerance_of_diagonal = 0.01;  // how far each side of the box may move

    // instances: world transforms of the mesh's instances (may be empty), for weights. Deterministic. Reports
    // progress 0..1 and honours watch.stop at least every 50 ms by throwing. Never throws on a consistent
    // mesh otherwise.
    Simplified (*simplify)(const Mesh& mesh, std::span<const Transform> instances, const Target& target,
                           const ParameterValues& parameters, const Watch& watch) = nullptr;

    // In its place, where the meshes of a scene are weighed against each other: all at once. A mesh without
    // instances stays as it is.
    SimplifiedScene (*simplify_scene)(std::span<const Mesh> meshes,
                                      std::span<const std::vector<Transform>> instances,
                                      const SceneTarget& target, const ParameterValues& parameters,
                                      const Watch& watch) = nullptr;
};

}  // namespace coppice
