#include "core/format/gltf/beyond_scene.h"

#include <algorithm>

#include "core/format/gltf/document.h"
#include "core/format/gltf/parsed.h"

namespace coppice::gltf {

namespace {

class Finds {
  public:
    void add(std::string_view what, const Pointer& where) {
        const auto is_it = [&](const Beyond& known) { return known.what == what; };
        if (std::none_of(found_.begin(), found_.end(), is_it))
            found_.push_back({std::string(what), where.text()});
    }
    std::vector<Beyond> take() { return std::move(found_); }

  private:
    std::vector<Beyond> found_;
};

void look_at_node(const Json& node, const Pointer& where, Finds& finds) {
    if (node.contains("camera")) finds.add("cameras", where);
    if (extension(node, "KHR_lights_punctual") != nullptr) finds.add("lights", where);
    if (const Json* instancing = extension(node, "EXT_mesh_gpu_instancing"))
        for (const auto& [name, index] : (*instancing)["attributes"].get_ref<const Json::object_t&>())
            if (name.starts_with('_')) finds.add("attributes of instances", where);
}

void look_at_primitive(const Json& primitive, const Pointer& where, Finds& finds) {
    const uint64_t mode = unsigned_at(primitive, "mode", 4);
    if (mode == 0) finds.add("points", where);
    if (mode > 0 && mode < 4) finds.add("lines", where);
}

bool holds_key(const Json& value, std::string_view key) {
    if (!value.is_structured()) return false;
    if (value.is_object() && value.contains(key)) return true;
    return std::any_of(value.begin(), value.end(), [&](const Json& item) { return holds_key(item, key); });
}

}  // namespace

std::vector<Beyond> beyond_scene(const Scene& scene) {
    const auto* source = dynamic_cast<const GltfDocument*>(scene.source.get());
    if (source == nullptr) return {};
    Finds finds;
    const auto for_each = [&](std::string_view array, const auto& look) {
        const Json& items = list(source->json, array);
        for (size_t i = 0; i < items.size(); ++i) look(items[i], pointer(array, i));
    };
    for_each("nodes", [&](const Json& node, const Pointer& where) { look_at_node(node, where, finds); });
    for_each("meshes", [&](const Json& mesh, const Pointer& where) {
        for (size_t p = 0; p < mesh["primitives"].size(); ++p)
            look_at_primitive(mesh["primitives"][p], where / "primitives" / p, finds);
    });
    for_each("materials", [&](const Json& material, const Pointer& where) {
        if (holds_key(material, "KHR_texture_transform")) finds.add("transforms of textures", where);
    });
    for_each("animations", [&](const Json&, const Pointer& where) { finds.add("animations", where); });
    return finds.take();
}

}  // namespace coppice::gltf
