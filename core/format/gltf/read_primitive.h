// A triangle primitive, however it was stored: as plain triangles and readable attributes.
#pragma once

#include <memory>
#include <string_view>
#include <vector>

#include "core/format/gltf/draco.h"
#include "core/format/gltf/parsed.h"

namespace coppice::gltf {

// Names and accessors are views into Parsed, and into PrimitiveData where Draco decoded them.
struct NamedAccessor {
    std::string_view name;
    const Accessor* accessor;
};
using NamedAccessors = std::vector<NamedAccessor>;  // by name, ascending

struct PrimitiveData {
    std::vector<uint32_t> triangles;  // 3 vertices each, counter-clockwise, in range
    const Accessor* positions = nullptr;
    NamedAccessors attributes;  // without POSITION
    std::vector<NamedAccessors> targets;
    std::unique_ptr<DracoPrimitive> decoded;  // what Draco decoded
};

// Triangles, strips and fans with positions; all else is passed through.
bool is_triangles(const Json& primitive);

// draco_limits: what a Draco stream may decode to; what accessors say was checked before. Throws
// asset_malformed, asset_too_large.
PrimitiveData read_primitive(const Parsed& parsed, const Json& primitive, const DracoLimits& draco_limits,
                             const Pointer& where, const Watch& watch);

}  // namespace coppice::gltf
