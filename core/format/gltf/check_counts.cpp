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
    const auto at_most = [](const char* array, size_t count, uint64_t limit, const char* setting) {
        require(count <= limit, ErrorCode::asset_too_large, pointer(array),
                "there are {} {}; at most {} are read (limit {})", count, array, limit, setting);
    };
    at_most("nodes", list(document, "nodes").size(), limits.nodes, "nodes");
    at_most("images", list(document, "images").size(), limits.images, "images");
    for (const char* array : {"accessors", "bufferViews"})
        at_most(array, list(document, array).size(), limits.accessors, "accessors");
    const Json& meshes = list(document, "meshes");
    at_most("meshes", meshes.size() + sum_of_sizes(meshes, "primitives"), limits.meshes_and_primitives,
            "meshes_and_primitives");

    size_t objects = 0;
    for (const char* array :
         {"scenes", "buffers", "materials", "textures", "samplers", "skins", "cameras", "animations"}) {
        objects += list(document, array).size();
        at_most(array, objects, limits.objects, "objects");
    }
    const Json& animations = list(document, "animations");
    objects += sum_of_sizes(animations, "channels") + sum_of_sizes(animations, "samplers");
    at_most("animations", objects, limits.objects, "objects");
}

}  // namespace coppice::gltf
