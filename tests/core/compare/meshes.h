// Small meshes, and small changes to them.
#pragma once

#include <cmath>
#include <cstdint>
#include <utility>
#include <vector>

#include "core/mesh/mesh.h"
#include "core/scene/scene.h"
#include "core/scene/transform.h"

namespace coppice::test {

// One wedge for each vertex, no attributes.
inline Mesh mesh_of(std::vector<Vec3f> positions, std::vector<uint32_t> triangles) {
    Mesh mesh;
    for (uint32_t v = 0; v < positions.size(); ++v) mesh.wedge_vertex.push_back(v);
    mesh.positions = std::move(positions);
    mesh.triangle_slot.assign(triangles.size() / 3, 0);
    mesh.triangles = std::move(triangles);
    mesh.slots.resize(1);
    return mesh;
}

inline Mesh moved(Mesh mesh, const Transform& by) {
    transform_mesh(by, mesh);
    return mesh;
}

inline Transform shift(double x, double y, double z) {
    return from_trs({x, y, z}, {0, 0, 0, 1}, {1, 1, 1});
}

inline Transform scaling(double x, double y, double z) {
    return from_trs({}, {0, 0, 0, 1}, {x, y, z});
}

inline Mesh octahedron(float radius) {
    const float r = radius;
    return mesh_of({{r, 0, 0}, {-r, 0, 0}, {0, r, 0}, {0, -r, 0}, {0, 0, r}, {0, 0, -r}},
                   {0, 2, 4, 2, 1, 4, 1, 3, 4, 3, 0, 4, 2, 0, 5, 1, 2, 5, 3, 1, 5, 0, 3, 5});
}

// Adds to every value of an attribute.
inline Mesh with_added(Mesh mesh, std::string_view name, float amount) {
    for (Attribute& attribute : mesh.attributes) {
        if (attribute.name != name) continue;
        for (float& value : attribute.values) value += amount;
    }
    return mesh;
}

inline void append(Mesh& mesh, const Mesh& other) {
    const auto vertices = static_cast<uint32_t>(mesh.vertex_count());
    const auto wedges = static_cast<uint32_t>(mesh.wedge_count());
    mesh.positions.insert(mesh.positions.end(), other.positions.begin(), other.positions.end());
    for (const uint32_t vertex : other.wedge_vertex) mesh.wedge_vertex.push_back(vertices + vertex);
    for (const uint32_t wedge : other.triangles) mesh.triangles.push_back(wedges + wedge);
    mesh.triangle_slot.insert(mesh.triangle_slot.end(), other.triangle_slot.begin(),
                              other.triangle_slot.end());
}

// A scene with a root node for each placement of one of the meshes.
inline Scene scene_of(std::vector<Mesh> meshes, const std::vector<std::pair<uint32_t, Transform>>& placed) {
    Scene scene;
    scene.meshes = std::move(meshes);
    scene.materials.resize(1);
    for (const auto& [mesh, local] : placed) {
        scene.roots.push_back(static_cast<uint32_t>(scene.nodes.size()));
        Node node;
        node.mesh = mesh;
        node.local = local;
        scene.nodes.push_back(std::move(node));
    }
    return scene;
}

}  // namespace coppice::test
