#include "core/format/gltf/fresh_document.h"

#include <algorithm>

#include "core/format/gltf/write_buffer.h"

namespace coppice::gltf {

namespace {

// One texture per image that a material uses; materials share it.
class Textures {
  public:
    Json use(const TextureUse& texture) {
        const auto found = std::find(images_.begin(), images_.end(), *texture.image);
        const auto index = static_cast<size_t>(found - images_.begin());
        if (found == images_.end()) images_.push_back(*texture.image);
        Json info = {{"index", index}};
        if (texture.texture_coordinates != 0) info["texCoord"] = texture.texture_coordinates;
        return info;
    }

    Json json() const {
        Json textures = Json::array();
        for (const uint32_t image : images_) textures.push_back({{"source", image}});
        return textures;
    }

  private:
    std::vector<uint32_t> images_;  // per texture
};

template <size_t N>
Json numbers(const std::array<float, N>& values) {
    Json out = Json::array();
    for (const float v : values) out.push_back(shortest(std::clamp(v, 0.0F, 1.0F)));
    return out;
}

Json material_json(const Material& material, Textures& textures) {
    Json json = Json::object();
    if (!material.name.empty()) json["name"] = material.name;
    Json& pbr = json["pbrMetallicRoughness"];
    pbr = {{"baseColorFactor", numbers(material.base_color)},
           {"metallicFactor", shortest(std::clamp(material.metallic, 0.0F, 1.0F))},
           {"roughnessFactor", shortest(std::clamp(material.roughness, 0.0F, 1.0F))}};
    if (material.base_color_texture.image)
        pbr["baseColorTexture"] = textures.use(material.base_color_texture);
    if (material.emissive_texture.image) json["emissiveTexture"] = textures.use(material.emissive_texture);
    if (material.normal_texture.image) json["normalTexture"] = textures.use(material.normal_texture);
    if (material.emissive != std::array<float, 3>{0, 0, 0})
        json["emissiveFactor"] = numbers(material.emissive);
    if (material.alpha != Material::Alpha::opaque)
        json["alphaMode"] = material.alpha == Material::Alpha::mask ? "MASK" : "BLEND";
    if (material.double_sided) json["doubleSided"] = true;
    return json;
}

}  // namespace

Json fresh_document(const Scene& scene) {
    Json json = {{"asset", {{"version", "2.0"}, {"generator", "coppice"}}}};
    Json root = Json::object();
    if (!scene.name.empty()) root["name"] = scene.name;
    if (!scene.roots.empty()) root["nodes"] = scene.roots;
    json["scenes"] = Json::array({root});
    json["scene"] = 0;
    Textures textures;
    for (const Material& material : scene.materials)
        json["materials"].push_back(material_json(material, textures));
    if (Json list = textures.json(); !list.empty()) json["textures"] = std::move(list);
    for (const Image& image : scene.images) {
        Json entry = Json::object();
        if (!image.name.empty()) entry["name"] = image.name;
        json["images"].push_back(std::move(entry));
    }
    return json;
}

}  // namespace coppice::gltf
