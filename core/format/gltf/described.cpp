#include "core/format/gltf/described.h"

#include "core/format/gltf/parsed.h"

namespace coppice::gltf {

Accessor described(const Json& accessor) {
    const auto& type = accessor.at("type").get_ref<const std::string&>();  // SCALAR, VEC2.., MAT2..
    const auto digit = static_cast<uint32_t>(type.back() - '0');
    Accessor out;
    out.rows = type == "SCALAR" ? 1 : digit;
    out.columns = type.starts_with("MAT") ? digit : 1;
    out.storage = {static_cast<ComponentType>(unsigned_at(accessor, "componentType")),
                   accessor.value("normalized", false)};
    out.count = unsigned_at(accessor, "count");
    return out;
}

}  // namespace coppice::gltf
