#include "core/format/gltf/semantics.h"

#include <charconv>
#include <utility>

namespace coppice::gltf {

namespace {

// Which component types a semantic may have, as bits: plain ones in the low byte, normalized ones in the high
// byte.
constexpr uint32_t f32 = 1;
constexpr uint32_t i8 = 2, u8 = 4, i16 = 8, u16 = 16;
constexpr uint32_t i8n = i8 << 8, u8n = u8 << 8, i16n = i16 << 8, u16n = u16 << 8;

struct Format {
    Semantic semantic;
    bool is_morph_delta;
    uint32_t components_low, components_high;
    uint32_t core;          // the specification's types
    uint32_t quantization;  // what KHR_mesh_quantization adds
};

constexpr Format formats[] = {
    {Semantic::position, false, 3, 3, f32, i8 | i8n | u8 | u8n | i16 | i16n | u16 | u16n},
    {Semantic::normal, false, 3, 3, f32, i8n | i16n},
    {Semantic::tangent, false, 4, 4, f32, i8n | i16n},
    {Semantic::texcoord, false, 2, 2, f32 | u8n | u16n, i8 | i8n | u8 | i16 | i16n | u16},
    {Semantic::color, false, 3, 4, f32 | u8n | u16n, 0},
    {Semantic::joints, false, 4, 4, u8 | u16, 0},
    {Semantic::weights, false, 4, 4, f32 | u8n | u16n, 0},
    {Semantic::position, true, 3, 3, f32, i8 | i8n | i16 | i16n},
    {Semantic::normal, true, 3, 3, f32, i8n | i16n},
    {Semantic::tangent, true, 3, 3, f32, i8n | i16n},
    {Semantic::texcoord, true, 2, 2, f32 | i8n | i16n | u8n | u16n, i8 | u8 | i16 | u16},
    {Semantic::color, true, 3, 4, f32 | i8n | i16n | u8n | u16n, 0},
};

uint32_t bit(Storage storage) {
    uint32_t plain = 0;
    switch (storage.type) {
        case ComponentType::float32:
            plain = f32;
            break;
        case ComponentType::int8:
            plain = i8;
            break;
        case ComponentType::uint8:
            plain = u8;
            break;
        case ComponentType::int16:
            plain = i16;
            break;
        case ComponentType::uint16:
            plain = u16;
            break;
        case ComponentType::uint32:
            break;
    }
    return storage.normalized ? plain << 8 : plain;
}

}  // namespace

AttributeName parse_attribute_name(std::string_view name) {
    if (name == "POSITION") return {Semantic::position};
    if (name == "NORMAL") return {Semantic::normal};
    if (name == "TANGENT") return {Semantic::tangent};
    if (name.starts_with('_')) return {Semantic::custom};
    constexpr std::pair<std::string_view, Semantic> indexed[] = {{"TEXCOORD_", Semantic::texcoord},
                                                                 {"COLOR_", Semantic::color},
                                                                 {"JOINTS_", Semantic::joints},
                                                                 {"WEIGHTS_", Semantic::weights}};
    for (const auto& [prefix, semantic] : indexed) {
        if (!name.starts_with(prefix)) continue;
        const std::string_view digits = name.substr(prefix.size());
        uint32_t set = 0;
        const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), set);
        const bool is_canonical = !digits.empty() && (digits.size() == 1 || digits.front() != '0');
        if (error == std::errc() && end == digits.data() + digits.size() && is_canonical)
            return {semantic, set};
    }
    return {};
}

bool is_valid_format(Semantic semantic, const Accessor& accessor, bool is_morph_delta, bool quantization) {
    if (semantic == Semantic::custom) return accessor.storage.type != ComponentType::uint32;
    for (const Format& format : formats) {
        if (format.semantic != semantic || format.is_morph_delta != is_morph_delta) continue;
        const uint32_t allowed = format.core | (quantization ? format.quantization : 0);
        return accessor.columns == 1 && accessor.rows >= format.components_low &&
               accessor.rows <= format.components_high && (allowed & bit(accessor.storage)) != 0;
    }
    return false;
}

}  // namespace coppice::gltf
