// KHR_draco_mesh_compression: a primitive as a Draco bitstream.
#pragma once

#include <map>
#include <string_view>
#include <vector>

#include "core/format/gltf/parsed.h"

namespace coppice::gltf {

// How much a stream may decode to.
struct DracoLimits {
    uint64_t triangles = 0;
    uint64_t attribute_bytes = 0;
};

struct DracoPrimitive {
    uint64_t vertex_count = 0;
    std::vector<uint32_t> triangles;  // 3 vertices each, in range
    std::map<std::string_view, Accessor>
        attributes;  // windows into owned; only those that the bitstream holds
    std::vector<Bytes> owned;
};

// primitive: has the extension. Throws asset_malformed, asset_too_large.
DracoPrimitive decode_draco(const Parsed& parsed, const Json& primitive, const DracoLimits& limits,
                            const Pointer& where);

}  // namespace coppice::gltf
