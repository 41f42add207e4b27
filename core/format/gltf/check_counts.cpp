#include "core/format/gltf/checks.h"

namespace coppice::gltf {

namespace {

size_t sum_of_sizes(const Json& objects, std::string_view key) {
    size_t sum = 0;
    for (const Json& object : objects) sum += list(object, key).size();
    return sum;
}

}  // namespace

void check_counts(const Json& document, const ReadLimits& limits) {
    const auto at_most = [](const char* array, size_t count, uint64_t limit, const char* setting,
                            const char* counted) {
        require(count <= limit, ErrorCode::asset_too_large, pointer(array),
                "there are {} {}; at most {} are read (limit {})", count, counted, limit, setting);
    };
    at_most("nodes", list(document, "nodes").size(), limits.nodes, "nodes", "nodes");
    at_most("images", list(document, "images").size(), limits.images, "images", "images");
    for (const char* array : {"accessors", "bufferViews"})
        at_most(array, list(document, array).size(), limits.accessors, "accessors", array);
    const Json& meshes = list(document, "meshes");
    at_most("meshes", meshes.size() + sum_of_sizes(meshes, "primitives"), limits.meshes_and_primitives,
            "meshes_and_primitives", "meshes and primitives");

    constexpr const char* counted = "materials, textures and other objects";
    size_t objects = 0;
    for (const char* array :
         {"scenes", "buffers", "materials", "textures", "samplers", "skins", "cameras", "animations"}) {
        objects += list(document, array).size();
        at_most(array, objects, limits.objects, "objects", counted);
    }
    const Json& animations = list(document, "animations");
    objects += sum_of_sizes(animations, "channels") + sum_of_sizes(animations, "samplers");
    at_most("animations", objects, limits.objects, "objects", counted);
}

}  // namespace coppice::gltf
