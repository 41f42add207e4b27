// Images of a written document: in its buffer, or as files beside it.
#pragma once

#include <vector>

#include "core/format/archive.h"
#include "core/format/gltf/write_buffer.h"
#include "core/scene/scene.h"

namespace coppice::gltf {

// Sets where each of document["images"] has its bytes. With as_files, images that had a path of their own
// keep it and are returned; all others go into the buffer. Equal bytes are stored once.
std::vector<NamedFile> write_images(const std::vector<Image>& images, Json& document, BufferWriter& buffer,
                                    bool as_files);

}  // namespace coppice::gltf
