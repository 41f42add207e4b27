// The one place that compiles tinygltf.
#define TINYGLTF_IMPLEMENTATION
#include "core/base/error.h"
#include "core/format/gltf/parsed.h"
#include "core/format/gltf/tiny_gltf_model.h"

namespace coppice::gltf {

namespace {

// Without what tinygltf would copy, 200 bytes a value, and nobody would ask it for.
Json plain(const Json& value) {
    if (value.is_array()) {
        Json out = Json::array();
        for (const Json& item : value) out.push_back(plain(item));
        return out;
    }
    if (!value.is_object()) return value;
    Json out = Json::object();
    for (const auto& [key, item] : value.items())
        if (key != "extras" && key != "extensions") out[key] = plain(item);
    return out;
}

Json appearance_of(const Json& checked) {
    Json out = Json::object();
    for (const char* part : {"asset", "materials", "textures"})
        if (checked.contains(part)) out[part] = plain(checked[part]);
    return out;
}

}  // namespace

tinygltf::Model parse_model(const Json& checked) {
    const std::string text = print_json(appearance_of(checked));
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
