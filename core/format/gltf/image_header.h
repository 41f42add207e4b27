// What the first bytes of an image say. Images are never decoded.
#pragma once

#include <string>

#include "core/base/bytes.h"

namespace coppice::gltf {

// Throws asset_malformed when a PNG, JPEG or WebP breaks off or is broken before its size is known. Other
// formats pass.
void check_image_header(ByteView bytes, const std::string& where);

}  // namespace coppice::gltf
