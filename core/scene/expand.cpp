#include "core/scene/expand.h"

#include <optional>
#include <utility>

#include "core/scene/instance.h"

namespace coppice {

void unfold_batches(Scene& scene) {
    const size_t given = scene.nodes.size();
    for (size_t n = 0; n < given; ++n) {
        if (scene.nodes[n].batch.empty()) continue;
        const std::vector<Transform> batch = std::exchange(scene.nodes[n].batch, {});
        const std::optional<uint32_t> mesh = std::exchange(scene.nodes[n].mesh, {});
        std::vector<uint32_t> unfolded;
        for (const Transform& local : batch) {
            Node child;
            child.name = scene.nodes[n].name;
            child.parent = static_cast<uint32_t>(n);
            child.local = local;
            child.mesh = mesh;
            unfolded.push_back(static_cast<uint32_t>(scene.nodes.size()));
            scene.nodes.push_back(std::move(child));
        }
        auto& children = scene.nodes[n].children;
        children.insert(children.begin(), unfolded.begin(), unfolded.end());
    }
}

Scene expand_meshes(const Scene& scene) {
    Scene expanded = scene;
    unfold_batches(expanded);
    std::vector<bool> taken(scene.meshes.size(), false);
    for (Node& node : expanded.nodes) {
        if (!node.mesh) continue;
        if (!taken[*node.mesh]) {
            taken[*node.mesh] = true;
            continue;
        }
        expanded.meshes.push_back(scene.meshes[*node.mesh]);
        node.mesh = static_cast<uint32_t>(expanded.meshes.size() - 1);
    }
    return expanded;
}

Scene bake_instances(const Scene& scene) {
    Scene baked;
    baked.name = scene.name;
    baked.materials = scene.materials;
    baked.images = scene.images;
    baked.source = scene.source;
    baked.warnings = scene.warnings;
    for (const Instance& instance : instances(scene)) {
        Mesh mesh = scene.meshes[instance.mesh];
        transform_mesh(instance.world, mesh);
        Node node;
        node.name = scene.nodes[instance.node].name;
        if (node.name.empty()) node.name = mesh.name;
        node.mesh = static_cast<uint32_t>(baked.meshes.size());
        mesh.name = node.name;
        baked.roots.push_back(static_cast<uint32_t>(baked.nodes.size()));
        baked.nodes.push_back(std::move(node));
        baked.meshes.push_back(std::move(mesh));
    }
    return baked;
}

}  // namespace coppice
