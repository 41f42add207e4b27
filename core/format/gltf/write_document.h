// A scene as a glTF document and its bytes, before it is put into a file.
#pragma once

#include <vector>

#include "core/base/watch.h"
#include "core/format/archive.h"
#include "core/format/asset.h"
#include "core/format/gltf/json_text.h"
#include "core/scene/scene.h"

namespace coppice::gltf {

enum class Images { embedded, as_files };

struct WrittenDocument {
    Json json;     // "buffers" has at most one, without uri
    Bytes buffer;  // empty: there is none
    std::vector<NamedFile> images;
    std::vector<uint64_t> mesh_bytes;  // per mesh of the scene that was given
    std::vector<Warning> warnings;
};

WrittenDocument write_document(const Scene& scene, const WriteOptions& options, Images images,
                               const Watch& watch);

}  // namespace coppice::gltf
