// The GLB container: a header and two chunks.
#pragma once

#include <optional>
#include <string_view>

#include "core/base/bytes.h"
#include "core/base/watch.h"

namespace coppice::gltf {

struct GlbChunks {
    ByteView json;
    std::optional<ByteView> binary = {};
};

// Views into bytes. Throws asset_malformed with a byte offset.
GlbChunks parse_glb(ByteView bytes);

// binary may be empty: then there is no second chunk.
Bytes print_glb(std::string_view json, ByteView binary, const Watch& watch = {});

}  // namespace coppice::gltf
