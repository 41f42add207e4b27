// glTF 2.0, as GLB or as JSON with buffers and images beside it: bytes to Scene and back.
//
// Reading: every rule that Khronos' validator calls an error is checked before a byte is used; what coppice
// may repair (docs: "Repairs") is repaired and listed in Scene::warnings, all else is refused with a JSON
// pointer. Writing: what coppice does not change is passed through from Scene::source. Two writes of one
// scene give the same bytes.
#pragma once

#include <vector>

#include "core/base/bytes.h"
#include "core/base/watch.h"
#include "core/format/archive.h"
#include "core/format/asset.h"
#include "core/format/limits.h"
#include "core/format/resources.h"
#include "core/scene/scene.h"

namespace coppice {

// True for bytes that begin like a GLB, whatever follows.
bool is_glb(ByteView bytes);

// A GLB (recognised by its first bytes) or glTF JSON. Throws asset_malformed, asset_unsupported (glTF 1.0),
// asset_extension_unsupported, asset_too_large, resource_missing, resource_forbidden.
Scene read_gltf(ByteView bytes, const Resources& resources, const ReadLimits& limits, const Watch& watch);

// One file that holds everything, images too. options.format is not looked at.
WrittenAsset write_glb(const Scene& scene, const WriteOptions& options, const Watch& watch);

struct GltfFiles {
    std::vector<NamedFile> files;      // BASE.gltf, BASE.bin (where there is one), then images
    std::vector<uint64_t> mesh_bytes;  // as in WrittenAsset
    std::vector<Warning> warnings;
};

// JSON with its buffer and its images as files of their own.
GltfFiles write_gltf(const Scene& scene, const WriteOptions& options, const Watch& watch);

}  // namespace coppice
