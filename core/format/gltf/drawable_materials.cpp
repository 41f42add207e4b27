#include "core/format/gltf/drawable_materials.h"

#include <algorithm>
#include <array>
#include <map>

#include "core/base/error.h"
#include "core/format/gltf/image_header.h"

namespace coppice::gltf {

namespace {

std::array<TextureUse*, 3> textures(Material& material) {
    return {&material.base_color_texture, &material.emissive_texture, &material.normal_texture};
}

std::array<const TextureUse*, 3> textures(const Material& material) {
    return {&material.base_color_texture, &material.emissive_texture, &material.normal_texture};
}

// What is wrong with an image; none where glTF can hold it. Types that nothing recognises pass: they are
// kept, and viewers say so.
std::optional<Warning> fault_of(const Image& image) {
    const std::string& where = image.path.empty() ? image.name : image.path;
    const std::string& type = image.mime_type;
    if (!type.empty() && type != "image/png" && type != "image/jpeg")
        return Warning{"image.unsupported",
                       fmt::format("a texture of type {} is left out: plain glTF holds PNG and JPEG", type),
                       where};
    try {
        check_image_header(image.bytes, where);
    } catch (const Error& error) {
        return Warning{"image.unreadable", error.message() + ", and is left out", where};
    }
    return {};
}

// Per image its index without the ones that are left out.
std::vector<std::optional<uint32_t>> kept_images(const Scene& scene, std::vector<Warning>& warnings) {
    std::vector<std::optional<uint32_t>> kept;
    uint32_t next = 0;
    for (const Image& image : scene.images) {
        const auto fault = fault_of(image);
        if (fault) warnings.push_back(*fault);
        kept.push_back(fault ? std::nullopt : std::optional(next++));
    }
    return kept;
}

bool has_coordinates(const Mesh& mesh, const MaterialSlot& slot, uint32_t set) {
    const std::string name = fmt::format("TEXCOORD_{}", set);
    for (size_t a = 0; a < mesh.attributes.size(); ++a)
        if (mesh.attributes[a].name == name) return slot.has(a);
    return false;
}

bool lacks_coordinates(const Mesh& mesh, const MaterialSlot& slot, const Material& material) {
    const auto uses = textures(material);
    return std::any_of(uses.begin(), uses.end(), [&](const TextureUse* use) {
        return use->image && !has_coordinates(mesh, slot, use->texture_coordinates);
    });
}

template <typename Visit>
void for_each_slot_without_coordinates(const Scene& scene, Visit&& visit) {
    for (size_t m = 0; m < scene.meshes.size(); ++m)
        for (size_t s = 0; s < scene.meshes[m].slots.size(); ++s) {
            const MaterialSlot& slot = scene.meshes[m].slots[s];
            if (slot.material && lacks_coordinates(scene.meshes[m], slot, scene.materials[*slot.material]))
                visit(m, s, *slot.material);
        }
}

void drop_images(Scene& scene, const std::vector<std::optional<uint32_t>>& kept) {
    std::vector<Image> images;
    for (size_t i = 0; i < kept.size(); ++i)
        if (kept[i]) images.push_back(std::move(scene.images[i]));
    scene.images = std::move(images);
    for (Material& material : scene.materials)
        for (TextureUse* use : textures(material))
            if (use->image) use->image = kept[*use->image];
}

}  // namespace

std::optional<Scene> with_drawable_materials(const Scene& scene, std::vector<Warning>& warnings) {
    const std::vector<std::optional<uint32_t>> kept = kept_images(scene, warnings);
    bool changes = std::count(kept.begin(), kept.end(), std::nullopt) > 0;
    for_each_slot_without_coordinates(scene, [&](size_t, size_t, uint32_t) { changes = true; });
    if (!changes) return {};

    Scene out = scene;
    drop_images(out, kept);
    std::map<uint32_t, uint32_t> plain;  // by the material with textures
    for_each_slot_without_coordinates(out, [&](size_t m, size_t s, uint32_t material) {
        const auto [at, is_new] = plain.try_emplace(material, static_cast<uint32_t>(out.materials.size()));
        if (is_new) {
            Material copy = out.materials[material];
            for (TextureUse* use : textures(copy)) use->image.reset();
            warnings.push_back({"texture.no_coordinates",
                                fmt::format("triangles with the material \"{}\" have no coordinates for its "
                                            "textures; they are drawn without",
                                            copy.name),
                                fmt::format("mesh \"{}\"", out.meshes[m].name)});
            out.materials.push_back(std::move(copy));
        }
        out.meshes[m].slots[s].material = at->second;
    });
    return out;
}

}  // namespace coppice::gltf
