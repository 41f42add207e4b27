#include "core/format/obj/companions.h"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <set>

#include "core/base/error.h"
#include "core/format/obj/mtl.h"
#include "core/format/obj/names.h"
#include "core/format/obj/obj_document.h"
#include "core/format/obj/object_writer.h"
#include "core/format/resources.h"

namespace coppice {

namespace {

std::string_view extension_of(std::string_view mime_type) {
    constexpr std::array<std::pair<std::string_view, std::string_view>, 6> extensions = {{
        {"image/png", "png"},
        {"image/jpeg", "jpg"},
        {"image/webp", "webp"},
        {"image/ktx2", "ktx2"},
        {"image/gif", "gif"},
        {"image/bmp", "bmp"},
    }};
    for (const auto& [type, extension] : extensions) {
        if (type == mime_type) return extension;
    }
    return "bin";
}

bool is_inside(const std::string& path) {
    try {
        require_inside_upload(path, "");
        return line_name(path, "") == path;
    } catch (const Error&) {
        return false;
    }
}

// Where the source had it, if that is a path inside, else textures/NAME.
std::vector<std::string> image_paths(const Scene& scene) {
    std::vector<std::string> paths;
    std::set<std::string> taken;
    for (size_t i = 0; i < scene.images.size(); ++i) {
        const Image& image = scene.images[i];
        std::string path = image.path;
        if (!is_inside(path) || taken.contains(path)) {
            std::string name = line_name(image.name, fmt::format("image-{}", i));
            std::replace_if(
                name.begin(), name.end(), [](char c) { return c == '/' || c == '\\' || c == ':'; }, '_');
            path = fmt::format("textures/{}.{}", name, extension_of(image.mime_type));
            for (int n = 2; taken.contains(path); ++n) {
                path = fmt::format("textures/{}-{}.{}", name, n, extension_of(image.mime_type));
            }
        }
        taken.insert(path);
        paths.push_back(std::move(path));
    }
    return paths;
}

ObjCompanions as_read(const Scene& scene, const ObjDocument& document) {
    ObjCompanions out;
    for (const Material& material : scene.materials) out.material_names.push_back(material.name);
    for (const NamedFile& library : document.libraries) {
        out.libraries.push_back(library.path);
        out.files.push_back(library);
    }
    for (const Image& image : scene.images) out.files.push_back({image.path, image.bytes});
    out.files.insert(out.files.end(), document.textures.begin(), document.textures.end());
    return out;
}

bool has_slot_without_material(const Scene& scene) {
    return std::any_of(scene.meshes.begin(), scene.meshes.end(), [](const Mesh& mesh) {
        return std::any_of(mesh.slots.begin(), mesh.slots.end(),
                           [](const MaterialSlot& s) { return !s.material; });
    });
}

ObjCompanions made_anew(const Scene& scene, const std::string& base_name) {
    ObjCompanions out;
    std::vector<Material> materials = scene.materials;
    if (materials.empty()) return out;
    if (has_slot_without_material(scene)) materials.emplace_back().name = obj_default_material;
    std::vector<std::string> names;
    for (const Material& material : materials) names.push_back(material.name);
    // The default's name is fixed, the others make room for it.
    if (materials.size() > scene.materials.size())
        std::rotate(names.rbegin(), names.rbegin() + 1, names.rend());
    names = unique_line_names(names, "material");
    if (materials.size() > scene.materials.size()) std::rotate(names.begin(), names.begin() + 1, names.end());

    const std::vector<std::string> paths = image_paths(scene);
    const std::string library = base_name + ".mtl";
    out.files.push_back({library, to_bytes(print_mtl(materials, names, paths))});
    out.libraries.push_back(library);
    std::vector<bool> used(scene.images.size());
    for (const Material& m : scene.materials) {
        for (const TextureUse& use : {m.base_color_texture, m.emissive_texture, m.normal_texture}) {
            if (use.image) used[*use.image] = true;
        }
    }
    for (size_t i = 0; i < used.size(); ++i) {
        if (used[i]) out.files.push_back({paths[i], scene.images[i].bytes});
    }
    if (std::find(used.begin(), used.end(), false) != used.end()) {
        out.warnings.push_back(
            {"format.lost", "textures other than base colour, emission and normals were left out", {}});
    }
    names.resize(scene.materials.size());
    out.material_names = std::move(names);
    return out;
}

}  // namespace

ObjCompanions obj_companions(const Scene& scene, const std::string& base_name) {
    if (const auto* document = dynamic_cast<const ObjDocument*>(scene.source.get()))
        return as_read(scene, *document);
    return made_anew(scene, base_name);
}

}  // namespace coppice
