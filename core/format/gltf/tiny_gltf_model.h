// tinygltf, as we use it: the materials and textures of a document that our checks have passed.
#pragma once

// tinygltf leaves these to whoever includes it.
#include <fstream>
#include <nlohmann/json.hpp>

#define TINYGLTF_NO_STB_IMAGE
#define TINYGLTF_NO_STB_IMAGE_WRITE
#define TINYGLTF_NO_EXTERNAL_IMAGE
#define TINYGLTF_NO_INCLUDE_STB_IMAGE
#define TINYGLTF_NO_INCLUDE_STB_IMAGE_WRITE
#define TINYGLTF_NO_FS
#define TINYGLTF_NO_INCLUDE_JSON
#include <tiny_gltf.h>

#include "core/format/gltf/json_text.h"

namespace coppice::gltf {

// tinygltf has no bounds checks of its own and takes its time, so it never sees a buffer, an image, a mesh or
// a node. Accessors are read by accessor.h alone. Throws asset_malformed with what tinygltf says.
tinygltf::Model parse_model(const Json& checked);

}  // namespace coppice::gltf
