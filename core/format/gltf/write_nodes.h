// The nodes of a document, as the scene has them.
#pragma once

#include <functional>
#include <set>
#include <string>

#include "core/base/watch.h"
#include "core/format/gltf/document.h"
#include "core/format/gltf/write_buffer.h"
#include "core/scene/scene.h"

namespace coppice::gltf {

struct NodeContext {
    const GltfDocument* source = nullptr;  // null: the scene did not come from glTF
    BufferWriter& buffer;
    std::function<uint32_t(uint32_t)> pass_accessor;
    std::set<std::string>& dropped;         // extensions that could not follow
    std::set<std::string> lost_attributes;  // of instances that are no batch any more, such as _ID
    bool uses_instancing = false;           // set when a batch is written
};

// Sets document["nodes"]. Nodes of the source keep their indices and all that the scene did not change;
// transforms that shear become two nested nodes, the inner ones appended. Throws asset_malformed for a
// singular transform of a node that is new or changed.
void write_nodes(const Scene& scene, Json& document, NodeContext& context, const Watch& watch);

}  // namespace coppice::gltf
