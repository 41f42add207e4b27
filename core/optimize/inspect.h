// What is in an asset, without changing it.
#pragma once

#include "core/format/asset.h"
#include "core/optimize/report.h"

namespace coppice {

struct InspectedMesh {
    std::string name;
    uint64_t instances = 0;
    uint64_t triangles = 0;
    uint64_t vertices = 0;
    uint64_t wedges = 0;
    std::vector<std::string> attributes;  // names
    uint64_t material_slots = 0;
    uint64_t border_edges = 0;
    uint64_t non_manifold_edges = 0;
};

struct Inspection {
    AssetSummary summary;
    Bounds bounds;  // of the scene, world units
    std::vector<InspectedMesh> meshes;
    uint64_t materials = 0;
    uint64_t images = 0;
    uint64_t nodes = 0;
    uint64_t bytes_saved_by_instancing = 0;  // what the given instancing already saves against one copy each
    std::vector<Warning> warnings;
};

Inspection inspect(const Upload& upload, const ReadLimits& limits, const Watch& watch);

}  // namespace coppice
