// A glTF document for a scene that did not come from glTF: everything but meshes, nodes and image bytes.
#pragma once

#include "core/format/gltf/json_text.h"
#include "core/scene/scene.h"

namespace coppice::gltf {

// asset, scenes, materials, textures, images (names and types only).
Json fresh_document(const Scene& scene);

}  // namespace coppice::gltf
