// A glTF mesh as one Mesh: a slot per triangle primitive, welded and cleaned.
#pragma once

#include "core/base/watch.h"
#include "core/format/gltf/parsed.h"
#include "core/format/limits.h"

namespace coppice::gltf {

// What has been read so far, held against the limits.
struct MeshBudget {
    uint64_t triangles = 0;
    uint64_t vertices = 0;         // of all primitives, with those that they share counted for each
    uint64_t attribute_bytes = 0;  // as floats
};

// index: of the mesh in the document. Repairs go to parsed.warnings. Throws asset_malformed, asset_too_large.
Mesh read_mesh(Parsed& parsed, uint32_t index, const ReadLimits& limits, MeshBudget& budget,
               const Watch& watch);

}  // namespace coppice::gltf
