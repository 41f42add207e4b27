#include <cmath>

#include "core/sample/scenes.h"

namespace coppice {

uint32_t add_mesh(Scene& scene, Mesh mesh) {
    scene.meshes.push_back(std::move(mesh));
    return static_cast<uint32_t>(scene.meshes.size() - 1);
}

uint32_t add_node(Scene& scene, std::string name, const Transform& local, std::optional<uint32_t> mesh,
                  std::optional<uint32_t> parent) {
    const auto index = static_cast<uint32_t>(scene.nodes.size());
    scene.nodes.push_back({.name = std::move(name), .parent = parent, .local = local, .mesh = mesh});
    (parent ? scene.nodes[*parent].children : scene.roots).push_back(index);
    return index;
}

Transform translation(Vec3d by) {
    return {.m = {1, 0, 0, by.x, 0, 1, 0, by.y, 0, 0, 1, by.z}};
}

Transform scaling(Vec3d by) {
    return {.m = {by.x, 0, 0, 0, 0, by.y, 0, 0, 0, 0, by.z, 0}};
}

Transform rotation(Vec3d axis, double radians) {
    const double s = std::sin(radians / 2);
    return from_trs({}, {axis.x * s, axis.y * s, axis.z * s, std::cos(radians / 2)}, {1, 1, 1});
}

void turn_y_up(Scene& scene) {
    const Transform turn = {.m = {1, 0, 0, 0, 0, 0, 1, 0, 0, -1, 0, 0}};
    const Transform back = {.m = {1, 0, 0, 0, 0, 0, -1, 0, 0, 1, 0, 0}};
    for (Mesh& mesh : scene.meshes) transform_mesh(turn, mesh);
    for (Node& node : scene.nodes) node.local = turn * node.local * back;
}

}  // namespace coppice
