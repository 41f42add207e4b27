// What of a read file goes along for the writer.
#pragma once

#include <memory>

#include "core/format/gltf/document.h"
#include "core/format/gltf/parsed.h"
#include "core/format/limits.h"

namespace coppice::gltf {

// Takes parsed.json. Copies the values that are passed through, with their repairs. Throws asset_too_large.
std::shared_ptr<GltfDocument> make_document(Parsed& parsed, const ReadLimits& limits);

}  // namespace coppice::gltf
