// The one place that compiles tinygltf.
#define TINYGLTF_IMPLEMENTATION
#include "core/base/error.h"
#include "core/format/gltf/parsed.h"
#include "core/format/gltf/tiny_gltf_model.h"

namespace coppice::gltf {

namespace {

Json without_extras(const Json& value) {
    if (value.is_array()) {
        Json out = Json::array();
        for (const Json& item : value) out.push_back(without_extras(item));
        return out;
    }
    if (!value.is_object()) return value;
    Json out = Json::object();
    for (const auto& [key, item] : value.items())
        if (key != "extras") out[key] = without_extras(item);
    return out;
}

Json structure_of(const Json& checked) {
    Json out = Json::object();
    for (const char* part : {"asset", "scene", "scenes", "nodes", "meshes", "materials", "textures", "skins"})
        if (checked.contains(part)) out[part] = without_extras(checked[part]);
    Json accessors = Json::array();
    for (const Json& accessor : list(checked, "accessors"))
        accessors.push_back({{"bufferView", 0},
                             {"componentType", accessor["componentType"]},
                             {"count", accessor["count"]},
                             {"type", accessor["type"]}});
    out["accessors"] = std::move(accessors);
    out["bufferViews"] = Json::array({{{"buffer", 0}, {"byteLength", 1}}});
    out["buffers"] = Json::array({{{"byteLength", 1}, {"uri", "data:application/octet-stream;base64,AA=="}}});
    return out;
}

}  // namespace

tinygltf::Model parse_model(const Json& checked) {
    const std::string text = print_json(structure_of(checked));
    tinygltf::TinyGLTF reader;
    tinygltf::Model model;
    std::string error;
    std::string warning;
    const bool is_read = reader.LoadASCIIFromString(&model, &error, &warning, text.data(),
                                                    static_cast<unsigned>(text.size()), "");
    require(is_read, ErrorCode::asset_malformed, "", "the document cannot be read: {}", error.substr(0, 300));
    return model;
}

}  // namespace coppice::gltf
