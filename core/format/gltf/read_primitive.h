// A triangle primitive, however it was stored: as plain triangles and readable attributes.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "core/format/gltf/parsed.h"

namespace coppice::gltf {

struct PrimitiveData {
    uint64_t vertex_count = 0;
    std::vector<uint32_t> triangles;             // 3 vertices each, counter-clockwise, in range
    std::map<std::string, Accessor> attributes;  // POSITION among them
    std::vector<std::map<std::string, Accessor>> targets;
    std::vector<Bytes> owned;  // what Draco decoded
    bool is_draco = false;
};

// Triangles, strips and fans with positions; all else is passed through.
bool is_triangles(const Json& primitive);

// triangle_limit: how many more triangles may be read. Throws asset_malformed, asset_too_large.
PrimitiveData read_primitive(const Parsed& parsed, const Json& primitive, uint64_t triangle_limit,
                             const std::string& where);

}  // namespace coppice::gltf
