// What an optimization did, in the names of the wire contract.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "core/format/format.h"
#include "core/scene/scene.h"
#include "core/simplify/algorithm.h"

namespace coppice {

struct AssetSummary {
    uint64_t bytes = 0;  // of the whole file, or of all parts of an upload, used or not
    Format format = Format::glb;
    uint64_t meshes = 0;  // unique
    uint64_t instances = 0;
    uint64_t unique_triangles = 0;    // stored; of an input those that reading left, once it had repaired
    uint64_t rendered_triangles = 0;  // after expansion of instances
    uint64_t unique_vertices = 0;     // positions
    uint64_t wedges = 0;
    uint64_t texture_coordinates = 0;  // distinct wedge values stored: wedges that have TEXCOORD_0
    uint64_t normals = 0;              // wedges that have NORMAL
    uint64_t texture_bytes = 0;
};

// Wall-clock milliseconds. total is read to write, without queue.
struct StageTimes {
    double read = 0, discover = 0, simplify = 0, encode = 0, write = 0, total = 0, queue = 0;
};

struct MeshReport {
    std::string name;
    uint64_t instances = 0;  // in the result
    uint64_t triangles_in = 0;
    uint64_t triangles_out = 0;
    double error_model_units = 0;
    double error_diagonal_fraction = 0;  // of the scene's diagonal, at the instance with the largest scale
    bool certified = false;
    StopReason stop_reason = StopReason::target;
};

struct Savings {
    double bytes_ratio = 0;        // output / input
    double bytes_vs_expanded = 0;  // output / the same with one stored copy per instance
    uint64_t bytes_saved_by_instancing = 0;
};

struct InstanceMapping {
    uint32_t node = 0;      // input node index
    uint32_t mesh = 0;      // output mesh index
    uint32_t instance = 0;  // index in the node's batch
};

// An instance of the input that is not in the output.
struct PrunedInstance {
    uint32_t node = 0;      // input node index
    uint32_t instance = 0;  // index in the input node's batch

    friend bool operator==(const PrunedInstance&, const PrunedInstance&) = default;
};

struct InstancingReport {
    uint64_t given = 0;                  // instances in the input
    uint64_t discovered = 0;             // copies that were found and shared; 0 until discovery exists
    uint64_t unique = 0;                 // unique meshes in the output
    std::vector<InstanceMapping> map;    // of those that were not pruned
    std::vector<PrunedInstance> pruned;  // empty unless the algorithm was told to
};

struct Report {
    std::string algorithm;
    ParameterValues parameters;
    AssetSummary input;
    AssetSummary output;
    StageTimes timing_ms;
    std::vector<MeshReport> meshes;
    Savings savings;
    InstancingReport instancing;
    std::vector<Warning> warnings;
    std::string budget = "bytes";
    std::vector<std::optional<double>> thresholds_used;  // per mesh; empty where the algorithm has none
    uint64_t reused_meshes = 0;  // taken from the store of simplified meshes; 0 until it exists
    std::string engine_version;
    std::string engine_build;  // commit and compiler
};

AssetSummary summarize(const Scene& scene, Format format, uint64_t bytes);

}  // namespace coppice
