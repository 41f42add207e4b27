// Scenes of formats that hold nothing but a mesh.
#pragma once

#include <utility>

#include "core/scene/scene.h"

namespace coppice {

// Adds the mesh, and a root node of its name that places it once.
inline void add_placed_mesh(Scene& scene, Mesh mesh) {
    Node node;
    node.name = mesh.name;
    node.mesh = static_cast<uint32_t>(scene.meshes.size());
    scene.roots.push_back(static_cast<uint32_t>(scene.nodes.size()));
    scene.nodes.push_back(std::move(node));
    scene.meshes.push_back(std::move(mesh));
}

}  // namespace coppice
