#include "core/sample/scenes.h"
#include "core/scene/expand.h"

namespace coppice {

namespace {

// The slot of the joined mesh for a material; samples have few, so a scan is fine.
uint32_t slot_of(Mesh& joined, std::optional<uint32_t> material) {
    for (uint32_t i = 0; i < joined.slots.size(); ++i) {
        if (joined.slots[i].material == material) return i;
    }
    joined.slots.push_back({.material = material});
    return static_cast<uint32_t>(joined.slots.size() - 1);
}

void append_mesh(Mesh& joined, const Mesh& mesh) {
    const auto first_vertex = static_cast<uint32_t>(joined.vertex_count());
    const auto first_wedge = static_cast<uint32_t>(joined.wedge_count());
    joined.positions.insert(joined.positions.end(), mesh.positions.begin(), mesh.positions.end());
    for (const uint32_t vertex : mesh.wedge_vertex) joined.wedge_vertex.push_back(first_vertex + vertex);
    for (size_t i = 0; i < mesh.attributes.size(); ++i) {  // every sample mesh has the same attributes
        const std::vector<float>& values = mesh.attributes[i].values;
        joined.attributes[i].values.insert(joined.attributes[i].values.end(), values.begin(), values.end());
    }
    for (const uint32_t wedge : mesh.triangles) joined.triangles.push_back(first_wedge + wedge);
    for (const uint32_t slot : mesh.triangle_slot) {
        joined.triangle_slot.push_back(slot_of(joined, mesh.slots[slot].material));
    }
}

}  // namespace

Scene join(const Scene& scene) {
    const Scene baked = bake_instances(scene);
    Mesh joined;
    joined.name = scene.name;
    joined.attributes = {{.name = "NORMAL", .components = 3}, {.name = "TEXCOORD_0", .components = 2}};
    for (const Node& node : baked.nodes) {
        if (node.mesh) append_mesh(joined, baked.meshes[*node.mesh]);
    }
    Scene out;
    out.name = scene.name;
    out.materials = scene.materials;
    out.images = scene.images;
    add_node(out, scene.name, {}, add_mesh(out, std::move(joined)));
    return out;
}

}  // namespace coppice
