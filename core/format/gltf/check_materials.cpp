#include <algorithm>
#include <array>
#include <set>

#include "core/format/gltf/checks.h"
#include "core/format/gltf/schema.h"

namespace coppice::gltf {

namespace {

// Calls see(texture info) for every texture that a material binds, in the known extensions too.
template <typename See>
void for_each_texture(const Json& value, std::string_view schema_name, const See& see) {
    const Schema& schema = *find_schema(schema_name);
    for (const Property& property : schema.properties) {
        if (property.kind != Kind::object || property.is_array || !value.contains(property.name)) continue;
        if (property.of.ends_with("extureInfo"))
            see(value[property.name]);
        else
            for_each_texture(value[property.name], property.of, see);
    }
    if (schema_name != "material") return;
    for (const ExtensionPlace& place : extension_places())
        if (place.on == "material" && !place.schema.empty())
            if (const Json* content = extension(value, place.extension))
                for_each_texture(*content, place.schema, see);
}

// TEXCOORD sets that a material needs, as the highest number plus one.
uint64_t texture_sets(const Json& material) {
    uint64_t sets = 0;
    for_each_texture(material, "material", [&](const Json& info) {
        uint64_t set = unsigned_at(info, "texCoord");
        if (const Json* transform = extension(info, "KHR_texture_transform"))
            set = unsigned_at(*transform, "texCoord", set);
        sets = std::max(sets, set + 1);
    });
    return sets;
}

bool needs_tangents(const Json& material) {
    const Json* clearcoat = extension(material, "KHR_materials_clearcoat");
    const Json* anisotropy = extension(material, "KHR_materials_anisotropy");
    return (clearcoat != nullptr && clearcoat->contains("clearcoatNormalTexture")) ||
           (anisotropy != nullptr && anisotropy->contains("anisotropyTexture"));
}

// What a material asks of the primitives that it is on.
struct Needs {
    uint64_t texture_sets = 0;
    bool tangents = false;
};

Needs needs_of(const Json& material) {
    return {texture_sets(material), needs_tangents(material) && !material.contains("normalTexture")};
}

void check_needs(const Json& primitive, const Needs& needs, uint32_t material, const Pointer& where) {
    const Json& attributes = primitive["attributes"];
    if (needs.texture_sets > 0) {
        const std::string last = fmt::format("TEXCOORD_{}", needs.texture_sets - 1);
        demand(attributes.contains(last), where, "has no {}, which its material {} needs", last, material);
    }
    demand(!needs.tangents || (attributes.contains("TANGENT") && attributes.contains("NORMAL")), where,
           "has no tangents, which its material {} needs", material);
}

// Materials of a primitive: its own and its variants.
std::vector<uint32_t> materials_of(const Json& primitive) {
    std::vector<uint32_t> materials;
    if (const auto own = index_at(primitive, "material")) materials.push_back(*own);
    if (const Json* variants = extension(primitive, "KHR_materials_variants"))
        for (const Json& mapping : list(*variants, "mappings"))
            materials.push_back(*index_at(mapping, "material"));
    return materials;
}

void check_variants(const Json& document, const Json& primitive, const Pointer& where) {
    const Json* variants = extension(primitive, "KHR_materials_variants");
    if (variants == nullptr) return;
    const Json* root = extension(document, "KHR_materials_variants");
    const Pointer at = where / "extensions" / "KHR_materials_variants";
    demand(root != nullptr, at, "is there, but the document lists no variants in its own extensions");
    std::set<uint32_t> seen;
    for (const Json& mapping : list(*variants, "mappings"))
        for (const Json& variant : list(mapping, "variants")) {
            demand(variant.get<uint64_t>() < (*root)["variants"].size(), at,
                   "refers to variant {}, but there are {}", variant.get<uint64_t>(),
                   (*root)["variants"].size());
            demand(seen.insert(variant.get<uint32_t>()).second, at, "maps variant {} twice",
                   variant.get<uint32_t>());
        }
}

void check_texture_source(const Parsed& parsed, const Json& holder, bool is_webp, const Pointer& where) {
    const auto source = index_at(holder, "source");
    if (!source) return;
    const std::string& type = parsed.images[*source].mime_type;
    if (is_webp)
        demand(type.empty() || type == "image/webp", where / "source",
               "is image {}, which is {} instead of image/webp", *source, type);
    else
        demand(type.empty() || type == "image/png" || type == "image/jpeg", where / "source",
               "is image {}, which is {} instead of image/png or image/jpeg", *source, type);
}

}  // namespace

void check_materials(Parsed& parsed, const Watch& watch) {
    const Json& document = parsed.json;
    std::vector<Needs> needs;  // per material
    for (const Json& material : list(document, "materials")) needs.push_back(needs_of(material));
    const Json& meshes = list(document, "meshes");
    for (size_t m = 0; m < meshes.size(); ++m)
        for (size_t p = 0; p < meshes[m]["primitives"].size(); ++p) {
            watch.check();
            const Json& primitive = meshes[m]["primitives"][p];
            const Pointer where = pointer("meshes", m, "primitives", p);
            check_variants(document, primitive, where);
            for (const uint32_t index : materials_of(primitive))
                check_needs(primitive, needs[index], index, where);
        }
    const Json& textures = list(document, "textures");
    for (size_t i = 0; i < textures.size(); ++i) {
        const Pointer where = pointer("textures", i);
        check_texture_source(parsed, textures[i], false, where);
        if (const Json* webp = extension(textures[i], "EXT_texture_webp"))
            check_texture_source(parsed, *webp, true, where / "extensions" / "EXT_texture_webp");
    }
}

void check_cameras_and_lights(const Parsed& parsed) {
    const Json& cameras = list(parsed.json, "cameras");
    for (size_t i = 0; i < cameras.size(); ++i) {
        const Pointer where = pointer("cameras", i);
        demand(cameras[i].contains("perspective") != cameras[i].contains("orthographic"), where,
               "must have exactly one of perspective and orthographic");
        const std::string type = text_at(cameras[i], "type");
        demand((type != "perspective" && type != "orthographic") || cameras[i].contains(type), where,
               "is of the type {}, but has no such object", type);
        const Json& view =
            cameras[i].contains("perspective") ? cameras[i]["perspective"] : cameras[i]["orthographic"];
        demand(!view.contains("zfar") || number_at(view, "zfar") > number_at(view, "znear"), where,
               "has zfar {}, which must be greater than znear {}", number_at(view, "zfar"),
               number_at(view, "znear"));
        for (const char* size : {"xmag", "ymag"})
            demand(!view.contains(size) || number_at(view, size) != 0, where,
                   "has {} 0, which it must not be", size);
    }
    const Json* root = extension(parsed.json, "KHR_lights_punctual");
    const Json& lights = root == nullptr ? list(parsed.json, "no lights") : (*root)["lights"];
    for (size_t i = 0; i < lights.size(); ++i) {
        const Pointer where = pointer("extensions", "KHR_lights_punctual", "lights", i);
        demand(text_at(lights[i], "type") != "spot" || lights[i].contains("spot"), where,
               "is a spot light, but has no 'spot'");
        const Json& spot = member(lights[i], "spot");
        const double inner = number_at(spot, "innerConeAngle");
        const double outer = number_at(spot, "outerConeAngle", 0.7853981633974483);
        demand(inner < outer, where / "spot" / "outerConeAngle",
               "is {}, which must be greater than innerConeAngle {}", outer, inner);
    }
    const Json& nodes = list(parsed.json, "nodes");
    for (size_t i = 0; i < nodes.size(); ++i) {
        const Json* light = extension(nodes[i], "KHR_lights_punctual");
        if (light == nullptr) continue;
        const Pointer where = pointer("nodes", i, "extensions", "KHR_lights_punctual");
        demand(root != nullptr, where, "is there, but the document lists no lights in its own extensions");
        demand(unsigned_at(*light, "light") < lights.size(), where / "light",
               "is {}, but there are {} lights", unsigned_at(*light, "light"), lights.size());
    }
}

}  // namespace coppice::gltf
