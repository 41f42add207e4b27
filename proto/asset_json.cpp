#include "proto/asset_json.h"

#include <nlohmann/json.hpp>

namespace coppice {

using Json = nlohmann::ordered_json;

Json to_json(const AssetSummary& summary) {
    return {{"bytes", summary.bytes},
            {"format", id(summary.format)},
            {"meshes", summary.meshes},
            {"instances", summary.instances},
            {"unique_triangles", summary.unique_triangles},
            {"rendered_triangles", summary.rendered_triangles},
            {"unique_vertices", summary.unique_vertices},
            {"wedges", summary.wedges},
            {"texture_coordinates", summary.texture_coordinates},
            {"normals", summary.normals},
            {"texture_bytes", summary.texture_bytes}};
}

Json to_json(const Warning& warning) {
    Json json = {{"code", warning.code}, {"message", warning.message}};
    if (!warning.where.empty()) json["where"] = warning.where;
    return json;
}

}  // namespace coppice
