// EXT_structural_metadata: the one extension outside the core that holds indices of buffer views.
#pragma once

#include <cstdint>
#include <functional>

#include "core/format/gltf/json_text.h"
#include "core/format/gltf/pointer.h"

namespace coppice::gltf {

// Calls see(index, where) with every buffer view that property tables of the document refer to; what it
// returns is written in its place. Throws asset_malformed where there should be an index and is none.
void for_each_metadata_view(Json& document, const std::function<uint32_t(uint32_t, const Pointer&)>& see);

}  // namespace coppice::gltf
