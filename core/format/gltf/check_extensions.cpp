#include <algorithm>
#include <map>
#include <set>

#include "core/format/gltf/checks.h"
#include "core/format/gltf/schema.h"

namespace coppice::gltf {

namespace {

// Extensions without a schema here, whose numbers are no indices of accessors or buffer views.
constexpr std::string_view harmless[] = {
    "AGI_articulations",
    "AGI_stk_metadata",
    "CESIUM_RTC",
    "EXT_instance_features",
    "EXT_lights_ies",
    "EXT_lights_image_based",
    "EXT_mesh_features",
    "EXT_structural_metadata",
    "EXT_texture_avif",
    "FB_ngon_encoding",
    "GOOGLE_texture_basis",
    "KHR_materials_diffuse_transmission",
    "KHR_xmp",
    "KHR_xmp_json_ld",
    "KHR_techniques_webgl",
    "KHR_node_hoverability",
    "KHR_node_selectability",
    "KHR_interactivity",
    "MSFT_lod",
    "MSFT_packing_normalRoughnessMetallic",
    "MSFT_packing_occlusionRoughnessMetallic",
    "MSFT_screencoverage",
    "MSFT_texture_dds",
    "NV_materials_mdl",
    "VRM",
    "VRMC_materials_mtoon",
    "VRMC_node_constraint",
    "VRMC_springBone",
    "VRMC_vrm",
};

bool is_known(std::string_view name) {
    const auto& places = extension_places();
    return std::any_of(places.begin(), places.end(), [&](const auto& p) { return p.extension == name; }) ||
           std::find(std::begin(harmless), std::end(harmless), name) != std::end(harmless);
}

bool holds_index(const Json& value) {
    if (value.is_number()) return value.is_number_unsigned();
    return value.is_structured() && std::any_of(value.begin(), value.end(), holds_index);
}

// Calls see(name, content) for every extension object; extras are the asset's own and not looked into.
template <typename See>
void for_each_extension(const Json& value, const See& see) {
    if (value.is_array())
        for (const Json& item : value)
            if (item.is_structured()) for_each_extension(item, see);
    if (!value.is_object()) return;
    for (const auto& [key, item] : value.get_ref<const Json::object_t&>()) {
        if (key == "extras" || !item.is_structured()) continue;
        if (key == "extensions" && item.is_object())
            for (const auto& [name, content] : item.template get_ref<const Json::object_t&>())
                see(name, content);
        for_each_extension(item, see);
    }
}

// By the extension's name, which is a view into the document.
using Uses = std::map<std::string_view, Pointer>;

void add_uses(const Json& object, const Pointer& where, Uses& uses) {
    const auto extensions = object.find("extensions");
    if (extensions == object.end()) return;
    for (const auto& [name, content] : extensions->get_ref<const Json::object_t&>())
        uses.try_emplace(name, where);
}

// Where each extension first stands on an object whose meaning it could change under our hands.
Uses geometric_uses(const Json& document, const Watch& watch) {
    Uses uses;
    for (const char* array : {"meshes", "accessors", "bufferViews", "nodes"}) {
        const Json& items = list(document, array);
        for (size_t i = 0; i < items.size(); ++i) {
            watch.check();
            add_uses(items[i], pointer(array, i), uses);
            const Json& primitives = list(items[i], "primitives");
            for (size_t p = 0; p < primitives.size(); ++p)
                add_uses(primitives[p], pointer(array, i, "primitives", p), uses);
        }
    }
    return uses;
}

bool is_version(std::string_view text) {
    const size_t dot = text.find('.');
    const auto digits = [](std::string_view part) {
        return !part.empty() &&
               std::all_of(part.begin(), part.end(), [](char c) { return c >= '0' && c <= '9'; });
    };
    return dot != std::string_view::npos && digits(text.substr(0, dot)) && digits(text.substr(dot + 1));
}

}  // namespace

void check_asset(const Json& document) {
    require(document.is_object(), ErrorCode::asset_malformed, "", "the document must be an object, but is {}",
            document.type_name());
    // glTF 1.0 need not have an asset object; it has maps where 2.0 has arrays.
    const Json& asset = member(document, "asset");
    const bool has_version = asset.is_object() && asset.contains("version") && asset["version"].is_string();
    require(has_version || !member(document, "meshes").is_object() || member(document, "meshes").empty(),
            ErrorCode::asset_unsupported, "/asset", "this looks like glTF 1.0; glTF 2.0 is read");
    if (!has_version) return;  // check_schema says what is wrong
    const auto version = asset["version"].get<std::string>();
    demand(is_version(version), pointer("asset", "version"), "is '{}'; it must be a version such as 2.0",
           version.substr(0, 30));
    require(version.starts_with("2."), ErrorCode::asset_unsupported, "/asset/version",
            "the asset is glTF {}; glTF 2.0 is read", version.substr(0, 30));
    if (!asset.contains("minVersion") || !asset["minVersion"].is_string()) return;
    const auto least = asset["minVersion"].get<std::string>();
    demand(is_version(least), pointer("asset", "minVersion"), "is '{}'; it must be a version such as 2.0",
           least.substr(0, 30));
    require(least == "2.0" || least.starts_with("1.") || least.starts_with("0."),
            ErrorCode::asset_unsupported, "/asset/minVersion", "the asset needs glTF {}; glTF 2.0 is read",
            least.substr(0, 30));
}

std::vector<std::string> extensions_with_unknown_indices(const Json& document) {
    std::set<std::string> found;
    for_each_extension(document, [&](const std::string& name, const Json& content) {
        if (!is_known(name) && holds_index(content)) found.insert(name);
    });
    return {found.begin(), found.end()};
}

void check_extensions(Parsed& parsed, const Watch& watch) {
    const Json& document = parsed.json;
    const Json& used = list(document, "extensionsUsed");
    const Json& required = list(document, "extensionsRequired");
    const Uses uses = geometric_uses(document, watch);
    std::set<std::string> declared;
    for (const Json& name : used) declared.insert(name.get<std::string>());
    for (size_t i = 0; i < required.size(); ++i) {
        const auto& name = required[i].get_ref<const std::string&>();
        demand(declared.contains(name), pointer("extensionsRequired", i),
               "is {}, which is not in extensionsUsed", name.substr(0, 100));
        if (is_known(name)) continue;
        if (const auto use = uses.find(name); use != uses.end())
            fail(ErrorCode::asset_extension_unsupported, use->second.text(),
                 fmt::format("{} needs the extension {}, which is required and not known here", use->second,
                             name.substr(0, 100)));
    }
    const auto lists = [&](const Json& names, std::string_view name) {
        return std::find(names.begin(), names.end(), name) != names.end();
    };
    demand(!lists(used, "KHR_mesh_quantization") || lists(required, "KHR_mesh_quantization"),
           pointer("extensionsUsed"), "lists KHR_mesh_quantization, which must be in extensionsRequired too");
    if (const auto use = uses.find("KHR_meshopt_compression"); use != uses.end())
        fail(ErrorCode::asset_extension_unsupported, use->second.text(),
             fmt::format("{} is compressed with KHR_meshopt_compression, which is not read; "
                         "EXT_meshopt_compression is",
                         use->second));
    for (const std::string& name : extensions_with_unknown_indices(document))
        parsed.warn(
            "extension.unknown",
            fmt::format("the extension {} holds numbers that may be indices: it is kept as it is, and all "
                        "accessors and buffer views keep theirs",
                        name));
}

}  // namespace coppice::gltf
