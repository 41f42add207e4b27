// What is kept of a glTF file so that the writer can pass through what the scene does not model.
#pragma once

#include <map>
#include <set>
#include <vector>

#include "core/format/gltf/accessor.h"
#include "core/format/gltf/json_text.h"
#include "core/scene/scene.h"

namespace coppice::gltf {

// Immutable once read. Owns its bytes: the upload may be gone when it is written.
struct GltfDocument : SourceDocument {
    Json json;                               // repaired
    std::map<uint32_t, Bytes> accessors;     // tightly packed values of those that are passed through
    std::map<uint32_t, Bytes> buffer_views;  // that extensions refer to
    uint64_t view_bytes = 0;                 // of those
    std::set<uint32_t> repaired;             // accessors whose values are not those of the file
    bool keeps_indices = false;  // an unknown extension may hold indices: every accessor and view stays
    std::vector<Node> nodes;     // as they were read: what differs now was changed on purpose
};

}  // namespace coppice::gltf
