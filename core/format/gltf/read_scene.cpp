#include "core/format/gltf/read_scene.h"

#include <algorithm>
#include <array>
#include <charconv>

#include "core/format/gltf/tiny_gltf_model.h"

namespace coppice::gltf {

namespace {

template <size_t N>
std::array<double, N> numbers_at(const Json& object, std::string_view key, std::array<double, N> otherwise) {
    const auto found = object.find(key);
    return found == object.end() ? otherwise : found->get<std::array<double, N>>();
}

Transform local_transform(const Json& node) {
    if (node.contains("matrix")) return from_column_major(numbers_at<16>(node, "matrix", {}));
    const auto [tx, ty, tz] = numbers_at<3>(node, "translation", {0, 0, 0});
    const auto [sx, sy, sz] = numbers_at<3>(node, "scale", {1, 1, 1});
    return from_trs({tx, ty, tz}, numbers_at<4>(node, "rotation", {0, 0, 0, 1}), {sx, sy, sz});
}

const Accessor* instance_attribute(const Parsed& parsed, const Json& attributes, std::string_view name) {
    const auto index = index_at(attributes, name);
    return index ? &parsed.accessors[*index] : nullptr;
}

std::vector<Transform> read_batch(const Parsed& parsed, const Json& extension) {
    const Json& attributes = extension["attributes"];
    const Accessor* translation = instance_attribute(parsed, attributes, "TRANSLATION");
    const Accessor* rotation = instance_attribute(parsed, attributes, "ROTATION");
    const Accessor* scale = instance_attribute(parsed, attributes, "SCALE");
    const uint64_t count = parsed.accessors[attributes.begin()->get<uint32_t>()].count;
    const auto vector = [](const Accessor* accessor, uint64_t i, Vec3d otherwise) {
        return accessor == nullptr ? otherwise
                                   : Vec3d{accessor->raw(i, 0), accessor->raw(i, 1), accessor->raw(i, 2)};
    };
    std::vector<Transform> batch;
    batch.reserve(count);
    for (uint64_t i = 0; i < count; ++i) {
        std::array<double, 4> q = {0, 0, 0, 1};
        if (rotation != nullptr)
            for (uint32_t c = 0; c < 4; ++c) q[c] = rotation->value(i, c);
        batch.push_back(from_trs(vector(translation, i, {0, 0, 0}), q, vector(scale, i, {1, 1, 1})));
    }
    return batch;
}

void mark_animated(const Json& document, std::vector<Node>& nodes) {
    for (const Json& animation : list(document, "animations"))
        for (const Json& channel : list(animation, "channels")) {
            const Json& target = channel["target"];
            const std::string path = text_at(target, "path");
            const auto node = index_at(target, "node");
            if (node && path != "weights") nodes[*node].animated = true;
            // KHR_animation_pointer names a node as /nodes/7/...
            const Json* pointed = extension(target, "KHR_animation_pointer");
            if (pointed == nullptr) continue;
            const std::string at = text_at(*pointed, "pointer");
            constexpr std::string_view prefix = "/nodes/";
            if (!at.starts_with(prefix)) continue;
            uint32_t index = 0;
            const auto parsed = std::from_chars(at.data() + prefix.size(), at.data() + at.size(), index);
            if (parsed.ec == std::errc() && index < nodes.size()) nodes[index].animated = true;
        }
}

std::optional<uint32_t> image_of(const tinygltf::Model& model, const Json& document, int texture) {
    if (texture < 0) return std::nullopt;
    if (const int source = model.textures[static_cast<size_t>(texture)].source; source >= 0)
        return static_cast<uint32_t>(source);
    for (const char* name : {"KHR_texture_basisu", "EXT_texture_webp"})
        if (const Json* other = extension(document["textures"][static_cast<size_t>(texture)], name))
            return index_at(*other, "source");
    return std::nullopt;
}

template <typename Info>
TextureUse texture_use(const tinygltf::Model& model, const Json& document, const Info& info) {
    return {image_of(model, document, info.index), static_cast<uint32_t>(std::max(info.texCoord, 0))};
}

}  // namespace

std::vector<Node> read_nodes(const Parsed& parsed) {
    const Json& json = list(parsed.json, "nodes");
    std::vector<Node> nodes(json.size());
    for (uint32_t i = 0; i < nodes.size(); ++i) {
        nodes[i].name = text_at(json[i], "name");
        nodes[i].local = local_transform(json[i]);
        nodes[i].mesh = index_at(json[i], "mesh");
        nodes[i].skinned = json[i].contains("skin");
        for (const Json& child : list(json[i], "children")) {
            nodes[i].children.push_back(child.get<uint32_t>());
            nodes[nodes[i].children.back()].parent = i;
        }
        if (const Json* instancing = extension(json[i], "EXT_mesh_gpu_instancing"))
            nodes[i].batch = read_batch(parsed, *instancing);
    }
    mark_animated(parsed.json, nodes);
    return nodes;
}

std::vector<Material> read_materials(const Json& document) {
    const tinygltf::Model model = parse_model(document);
    std::vector<Material> materials;
    for (const tinygltf::Material& from : model.materials) {
        Material material;
        material.name = from.name;
        const tinygltf::PbrMetallicRoughness& pbr = from.pbrMetallicRoughness;
        for (size_t c = 0; c < 4 && c < pbr.baseColorFactor.size(); ++c)
            material.base_color[c] = static_cast<float>(pbr.baseColorFactor[c]);
        for (size_t c = 0; c < 3 && c < from.emissiveFactor.size(); ++c)
            material.emissive[c] = static_cast<float>(from.emissiveFactor[c]);
        material.metallic = static_cast<float>(pbr.metallicFactor);
        material.roughness = static_cast<float>(pbr.roughnessFactor);
        material.base_color_texture = texture_use(model, document, pbr.baseColorTexture);
        material.emissive_texture = texture_use(model, document, from.emissiveTexture);
        material.normal_texture = texture_use(model, document, from.normalTexture);
        material.alpha = from.alphaMode == "MASK"    ? Material::Alpha::mask
                         : from.alphaMode == "BLEND" ? Material::Alpha::blend
                                                     : Material::Alpha::opaque;
        material.double_sided = from.doubleSided;
        materials.push_back(std::move(material));
    }
    return materials;
}

std::vector<uint32_t> read_roots(const Json& document, const std::vector<Node>& nodes) {
    const Json& scenes = list(document, "scenes");
    if (!scenes.empty())
        return list(scenes[unsigned_at(document, "scene")], "nodes").get<std::vector<uint32_t>>();
    std::vector<uint32_t> roots;
    for (uint32_t i = 0; i < nodes.size(); ++i)
        if (!nodes[i].parent) roots.push_back(i);
    return roots;
}

}  // namespace coppice::gltf
