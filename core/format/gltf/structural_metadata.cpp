#include "core/format/gltf/structural_metadata.h"

#include "core/format/gltf/parsed.h"

namespace coppice::gltf {

void for_each_metadata_view(Json& document, const std::function<uint32_t(uint32_t, const Pointer&)>& see) {
    if (extension(document, "EXT_structural_metadata") == nullptr) return;
    Json& metadata = document["extensions"]["EXT_structural_metadata"];
    if (!metadata.contains("propertyTables")) return;
    const Pointer where = pointer("extensions", "EXT_structural_metadata", "propertyTables");
    const size_t views = list(document, "bufferViews").size();
    demand(metadata["propertyTables"].is_array(), where, "must be an array");
    for (Json& table : metadata["propertyTables"]) {
        demand(table.is_object(), where, "must hold objects");
        if (!table.contains("properties")) continue;
        demand(table["properties"].is_object(), where, "must have objects as 'properties'");
        for (auto& [name, property] : table["properties"].items()) {
            demand(property.is_object(), where, "must have objects in 'properties'");
            for (const char* part : {"values", "arrayOffsets", "stringOffsets"}) {
                if (!property.contains(part)) continue;
                const Json& index = property[part];
                demand(index.is_number_unsigned() && index.get<uint64_t>() < views, where,
                       "refer to a buffer view that is not there, as '{}' of {}", part, name.substr(0, 100));
                property[part] = see(index.get<uint32_t>(), where);
            }
        }
    }
}

}  // namespace coppice::gltf
