// A mesh as glTF primitives.
#pragma once

#include <functional>
#include <set>

#include "core/base/watch.h"
#include "core/format/gltf/document.h"
#include "core/format/gltf/write_buffer.h"
#include "core/scene/scene.h"

namespace coppice::gltf {

struct MeshContext {
    BufferWriter& buffer;
    bool quantization = false;                        // KHR_mesh_quantization is declared
    std::function<uint32_t(uint32_t)> pass_accessor;  // index of a source accessor in the result
    std::set<std::string>& dropped;                   // extensions that could not follow
    const Watch& watch;
};

// The JSON of a mesh. source: its object in the source's document, null where there is none: then names,
// extras, extensions, weights and the primitives of points and lines come from it.
Json write_mesh(const Mesh& mesh, const Json* source, MeshContext& context);

}  // namespace coppice::gltf
