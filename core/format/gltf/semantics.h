// Names and formats of vertex attributes.
#pragma once

#include <cstdint>
#include <string_view>

#include "core/format/gltf/accessor.h"

namespace coppice::gltf {

enum class Semantic : uint8_t {
    position,
    normal,
    tangent,
    texcoord,
    color,
    joints,
    weights,
    custom,
    invalid
};

struct AttributeName {
    Semantic semantic = Semantic::invalid;
    uint32_t set = 0;  // n of TEXCOORD_n
};

AttributeName parse_attribute_name(std::string_view name);

// Whether the specification, or KHR_mesh_quantization where that is used, allows the accessor for it.
bool is_valid_format(Semantic semantic, const Accessor& accessor, bool is_morph_delta, bool quantization);

}  // namespace coppice::gltf
