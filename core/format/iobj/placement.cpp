#include "core/format/iobj/placement.h"

#include <map>
#include <string>
#include <vector>

#include "core/base/error.h"

namespace coppice {

namespace {

using InstancesOfObject = std::vector<std::vector<const InstanceDirective*>>;

InstancesOfObject instances_by_object(const ObjFile& file) {
    InstancesOfObject of_object(file.objects.size());
    std::map<std::string, size_t> object_numbers;  // not hashed: the file chooses the names
    for (size_t i = 0; i < file.objects.size(); ++i) object_numbers.emplace(file.objects[i], i);
    for (const InstanceDirective& instance : file.instances) {
        const auto at = object_numbers.find(instance.object);
        require(at != object_numbers.end(), ErrorCode::asset_malformed, fmt::format("line {}", instance.line),
                "#@instance names object \"{}\", which the file does not have", instance.object);
        of_object[at->second].push_back(&instance);
    }
    return of_object;
}

void add_root(Scene& scene, const std::string& name, uint32_t mesh, const Transform& placement) {
    Node node;
    node.name = name;
    node.mesh = mesh;
    node.local = placement;
    scene.roots.push_back(static_cast<uint32_t>(scene.nodes.size()));
    scene.nodes.push_back(std::move(node));
}

}  // namespace

void place_objects(const ObjFile& file, std::span<const std::optional<uint32_t>> mesh_of_object,
                   const ReadLimits& limits, Scene& scene) {
    const InstancesOfObject of_object = instances_by_object(file);
    uint64_t rendered = 0;
    for (size_t object = 0; object < file.objects.size(); ++object) {
        if (!mesh_of_object[object]) continue;
        const uint32_t mesh = *mesh_of_object[object];
        const auto& placed = of_object[object];
        if (placed.empty()) add_root(scene, file.objects[object], mesh, {});
        for (const InstanceDirective* instance : placed)
            add_root(scene, instance->name, mesh, instance->placement);
        rendered += scene.meshes[mesh].triangle_count() * std::max<uint64_t>(1, placed.size());
    }
    require(scene.nodes.size() <= limits.nodes, ErrorCode::asset_too_large, "",
            "the OBJ has {} objects and instances, over the limit nodes of {}", scene.nodes.size(),
            limits.nodes);
    require(rendered <= limits.rendered_triangles, ErrorCode::asset_too_large, "",
            "the instances draw {} triangles, over the limit rendered_triangles of {}", rendered,
            limits.rendered_triangles);
}

}  // namespace coppice
