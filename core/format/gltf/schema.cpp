#include "core/format/gltf/schema.h"

#include <map>
#include <numbers>

namespace coppice::gltf {

Property Property::required() const {
    Property copy = *this;
    copy.required_ = true;
    return copy;
}
Property Property::at_least(double value) const {
    Property copy = *this;
    copy.min = value;
    return copy;
}
Property Property::above(double value) const {
    Property copy = at_least(value);
    copy.above_min = true;
    return copy;
}
Property Property::between(double low, double high) const {
    Property copy = at_least(low);
    copy.max = high;
    return copy;
}
Property Property::items(size_t at_least, size_t at_most) const {
    Property copy = *this;
    copy.is_array = true;
    copy.min_items = at_least;
    copy.max_items = at_most;
    return copy;
}
Property Property::unique() const {
    Property copy = *this;
    copy.is_unique = true;
    return copy;
}

namespace {

Property integer(std::string_view name) {
    return {.name = name, .kind = Kind::integer};
}
Property number(std::string_view name) {
    return {.name = name, .kind = Kind::number};
}
Property boolean(std::string_view name) {
    return {.name = name, .kind = Kind::boolean};
}
Property text(std::string_view name) {
    return {.name = name, .kind = Kind::text};
}
Property reference(std::string_view name, std::string_view to) {
    return {.name = name, .kind = Kind::reference, .of = to};
}
Property object(std::string_view name, std::string_view schema) {
    return {.name = name, .kind = Kind::object, .of = schema};
}
Property objects(std::string_view name, std::string_view schema) {
    return object(name, schema).items(1);
}
Property reference_map(std::string_view name, std::string_view to) {
    return {.name = name, .kind = Kind::reference_map, .of = to};
}
Property integer_of(std::string_view name, std::vector<int64_t> allowed) {
    Property property = integer(name);
    property.integers = std::move(allowed);
    return property;
}
Property text_of(std::string_view name, std::vector<std::string_view> allowed) {
    Property property = text(name);
    property.texts = std::move(allowed);
    return property;
}
Property fraction(std::string_view name) {
    return number(name).between(0, 1);
}
Property vector3(std::string_view name) {
    return number(name).items(3, 3);
}

// glTF 2.0 specification, section 5. Values that the validator merely warns about (an unknown MIME type,
// filter or wrapping) are not listed: they pass.
std::vector<Schema> core_schemas() {
    return {
        {"root",
         {object("asset", "asset").required(), reference("scene", "scenes"), objects("scenes", "scene"),
          objects("nodes", "node"), objects("meshes", "mesh"), objects("accessors", "accessor"),
          objects("bufferViews", "bufferView"), objects("buffers", "buffer"),
          objects("materials", "material"), objects("textures", "texture"), objects("images", "image"),
          objects("samplers", "sampler"), objects("skins", "skin"), objects("cameras", "camera"),
          objects("animations", "animation"), text("extensionsUsed").items(1).unique(),
          text("extensionsRequired").items(1).unique()}},
        {"asset", {text("version").required(), text("minVersion"), text("copyright"), text("generator")}},
        {"scene", {text("name"), reference("nodes", "nodes").items(1).unique()}},
        {"node",
         {text("name"), reference("camera", "cameras"), reference("children", "nodes").items(1).unique(),
          reference("skin", "skins"), reference("mesh", "meshes"), number("matrix").items(16, 16),
          number("rotation").between(-1, 1).items(4, 4), vector3("scale"), vector3("translation"),
          number("weights").items(1)}},
        {"buffer", {text("name"), text("uri"), integer("byteLength").at_least(1).required()}},
        {"bufferView",
         {text("name"), reference("buffer", "buffers").required(), integer("byteOffset").at_least(0),
          integer("byteLength").at_least(1).required(), integer("byteStride").between(4, 252),
          integer("target")}},
        {"accessor",
         {text("name"), reference("bufferView", "bufferViews"), integer("byteOffset").at_least(0),
          integer_of("componentType", {5120, 5121, 5122, 5123, 5125, 5126}).required(), boolean("normalized"),
          integer("count").at_least(1).required(),
          text_of("type", {"SCALAR", "VEC2", "VEC3", "VEC4", "MAT2", "MAT3", "MAT4"}).required(),
          number("min").items(1, 16), number("max").items(1, 16), object("sparse", "sparse")}},
        {"sparse",
         {integer("count").at_least(1).required(), object("indices", "sparse indices").required(),
          object("values", "sparse values").required()}},
        {"sparse indices",
         {reference("bufferView", "bufferViews").required(), integer("byteOffset").at_least(0),
          integer_of("componentType", {5121, 5123, 5125}).required()}},
        {"sparse values",
         {reference("bufferView", "bufferViews").required(), integer("byteOffset").at_least(0)}},
        {"mesh", {text("name"), objects("primitives", "primitive").required(), number("weights").items(1)}},
        {"primitive",
         {reference_map("attributes", "accessors").required(), reference("indices", "accessors"),
          reference("material", "materials"), integer_of("mode", {0, 1, 2, 3, 4, 5, 6}),
          reference_map("targets", "accessors").items(1)}},
        {"material",
         {text("name"), object("pbrMetallicRoughness", "pbrMetallicRoughness"),
          object("normalTexture", "normalTextureInfo"), object("occlusionTexture", "occlusionTextureInfo"),
          object("emissiveTexture", "textureInfo"), fraction("emissiveFactor").items(3, 3), text("alphaMode"),
          number("alphaCutoff").at_least(0), boolean("doubleSided")}},
        {"pbrMetallicRoughness",
         {fraction("baseColorFactor").items(4, 4), object("baseColorTexture", "textureInfo"),
          fraction("metallicFactor"), fraction("roughnessFactor"),
          object("metallicRoughnessTexture", "textureInfo")}},
        {"textureInfo", {reference("index", "textures").required(), integer("texCoord").at_least(0)}},
        {"normalTextureInfo",
         {reference("index", "textures").required(), integer("texCoord").at_least(0), number("scale")}},
        {"occlusionTextureInfo",
         {reference("index", "textures").required(), integer("texCoord").at_least(0), fraction("strength")}},
        {"texture", {text("name"), reference("sampler", "samplers"), reference("source", "images")}},
        {"image", {text("name"), text("uri"), text("mimeType"), reference("bufferView", "bufferViews")}},
        {"sampler",
         {text("name"), integer("magFilter"), integer("minFilter"), integer("wrapS"), integer("wrapT")}},
        {"camera",
         {text("name"), text("type").required(), object("orthographic", "orthographic"),
          object("perspective", "perspective")}},
        {"orthographic",
         {number("xmag").required(), number("ymag").required(), number("zfar").above(0).required(),
          number("znear").at_least(0).required()}},
        {"perspective",
         {number("yfov").above(0).required(), number("znear").above(0).required(), number("zfar").above(0),
          number("aspectRatio").above(0)}},
        {"skin",
         {text("name"), reference("inverseBindMatrices", "accessors"), reference("skeleton", "nodes"),
          reference("joints", "nodes").items(1).unique().required()}},
        {"animation",
         {text("name"), objects("channels", "channel").required(),
          objects("samplers", "animation sampler").required()}},
        {"channel", {integer("sampler").at_least(0).required(), object("target", "target").required()}},
        {"target", {reference("node", "nodes"), text("path").required()}},
        {"animation sampler",
         {reference("input", "accessors").required(), reference("output", "accessors").required(),
          text_of("interpolation", {"LINEAR", "STEP", "CUBICSPLINE"})}},
    };
}

std::vector<Schema> material_extension_schemas() {
    return {
        {"anisotropy",
         {fraction("anisotropyStrength"), number("anisotropyRotation"),
          object("anisotropyTexture", "textureInfo")}},
        {"clearcoat",
         {fraction("clearcoatFactor"), object("clearcoatTexture", "textureInfo"),
          fraction("clearcoatRoughnessFactor"), object("clearcoatRoughnessTexture", "textureInfo"),
          object("clearcoatNormalTexture", "normalTextureInfo")}},
        {"dispersion", {number("dispersion").at_least(0)}},
        {"emissive strength", {number("emissiveStrength").at_least(0)}},
        {"ior", {number("ior").at_least(0)}},
        {"iridescence",
         {fraction("iridescenceFactor"), object("iridescenceTexture", "textureInfo"),
          number("iridescenceIor").at_least(1), number("iridescenceThicknessMinimum").at_least(0),
          number("iridescenceThicknessMaximum").at_least(0),
          object("iridescenceThicknessTexture", "textureInfo")}},
        {"sheen",
         {fraction("sheenColorFactor").items(3, 3), object("sheenColorTexture", "textureInfo"),
          fraction("sheenRoughnessFactor"), object("sheenRoughnessTexture", "textureInfo")}},
        {"specular",
         {fraction("specularFactor"), object("specularTexture", "textureInfo"),
          number("specularColorFactor").at_least(0).items(3, 3),
          object("specularColorTexture", "textureInfo")}},
        {"specular glossiness",
         {fraction("diffuseFactor").items(4, 4), object("diffuseTexture", "textureInfo"),
          fraction("specularFactor").items(3, 3), fraction("glossinessFactor"),
          object("specularGlossinessTexture", "textureInfo")}},
        {"transmission", {fraction("transmissionFactor"), object("transmissionTexture", "textureInfo")}},
        {"volume",
         {number("thicknessFactor").at_least(0), object("thicknessTexture", "textureInfo"),
          number("attenuationDistance").above(0), fraction("attenuationColor").items(3, 3)}},
        {"texture transform",
         {number("offset").items(2, 2), number("rotation"), number("scale").items(2, 2),
          integer("texCoord").at_least(0)}},
        {"texture source", {reference("source", "images")}},
    };
}

std::vector<Schema> other_extension_schemas() {
    return {
        {"lights", {objects("lights", "light").required()}},
        {"light",
         {text("name"), text("type").required(), fraction("color").items(3, 3),
          number("intensity").at_least(0), number("range").above(0), object("spot", "spot")}},
        {"spot",
         {number("innerConeAngle").between(0, std::numbers::pi / 2),
          number("outerConeAngle").above(0).between(0, std::numbers::pi / 2)}},
        {"node light", {integer("light").at_least(0).required()}},
        {"variants", {objects("variants", "variant").required()}},
        {"variant", {text("name").required()}},
        {"primitive variants", {objects("mappings", "variant mapping").required()}},
        {"variant mapping",
         {text("name"), integer("variants").at_least(0).items(1).unique().required(),
          reference("material", "materials").required()}},
        {"node visibility", {boolean("visible")}},
        {"animation pointer", {text("pointer").required()}},
        {"gpu instancing", {reference_map("attributes", "accessors").required()}},
        {"draco",
         {reference("bufferView", "bufferViews").required(), reference_map("attributes", "").required()}},
        {"meshopt view",
         {reference("buffer", "buffers").required(), integer("byteOffset").at_least(0),
          integer("byteLength").at_least(1).required(), integer("byteStride").between(1, 256).required(),
          integer("count").at_least(1).required(),
          text_of("mode", {"ATTRIBUTES", "TRIANGLES", "INDICES"}).required(),
          text_of("filter", {"NONE", "OCTAHEDRAL", "QUATERNION", "EXPONENTIAL"})}},
        {"meshopt buffer", {boolean("fallback")}},
    };
}

std::map<std::string_view, Schema> all_schemas() {
    std::map<std::string_view, Schema> all;
    for (auto* some : {&core_schemas, &material_extension_schemas, &other_extension_schemas})
        for (Schema& schema : (*some)()) all.emplace(schema.name, std::move(schema));
    return all;
}

}  // namespace

const Schema* find_schema(std::string_view name) {
    static const std::map<std::string_view, Schema> schemas = all_schemas();
    const auto found = schemas.find(name);
    return found == schemas.end() ? nullptr : &found->second;
}

const std::vector<ExtensionPlace>& extension_places() {
    static const std::vector<ExtensionPlace> places = {
        {"KHR_lights_punctual", "root", "lights"},
        {"KHR_lights_punctual", "node", "node light"},
        {"KHR_materials_anisotropy", "material", "anisotropy"},
        {"KHR_materials_clearcoat", "material", "clearcoat"},
        {"KHR_materials_dispersion", "material", "dispersion"},
        {"KHR_materials_emissive_strength", "material", "emissive strength"},
        {"KHR_materials_ior", "material", "ior"},
        {"KHR_materials_iridescence", "material", "iridescence"},
        {"KHR_materials_pbrSpecularGlossiness", "material", "specular glossiness"},
        {"KHR_materials_sheen", "material", "sheen"},
        {"KHR_materials_specular", "material", "specular"},
        {"KHR_materials_transmission", "material", "transmission"},
        {"KHR_materials_unlit", "material", ""},
        {"KHR_materials_volume", "material", "volume"},
        {"KHR_materials_variants", "root", "variants"},
        {"KHR_materials_variants", "primitive", "primitive variants"},
        {"KHR_texture_transform", "textureInfo", "texture transform"},
        {"KHR_texture_transform", "normalTextureInfo", "texture transform"},
        {"KHR_texture_transform", "occlusionTextureInfo", "texture transform"},
        {"KHR_texture_basisu", "texture", "texture source"},
        {"EXT_texture_webp", "texture", "texture source"},
        {"KHR_node_visibility", "node", "node visibility"},
        {"KHR_animation_pointer", "target", "animation pointer"},
        {"KHR_mesh_quantization", "", ""},
        {"EXT_mesh_gpu_instancing", "node", "gpu instancing"},
        {"KHR_draco_mesh_compression", "primitive", "draco"},
        {"EXT_meshopt_compression", "bufferView", "meshopt view"},
        {"EXT_meshopt_compression", "buffer", "meshopt buffer"},
    };
    return places;
}

}  // namespace coppice::gltf
