#include "core/scene/instance.h"

#include <gtest/gtest.h>

#include "core/base/error.h"
#include "core/base/watched_loop.h"
#include "core/scene/expand.h"

namespace coppice {
namespace {

Transform move_x(double x) {
    return from_trs({x, 0, 0}, {0, 0, 0, 1}, {1, 1, 1});
}

uint32_t add_node(Scene& scene, std::optional<uint32_t> parent, const Transform& local,
                  std::optional<uint32_t> mesh = {}) {
    const auto index = static_cast<uint32_t>(scene.nodes.size());
    Node node;
    node.parent = parent;
    node.local = local;
    node.mesh = mesh;
    scene.nodes.push_back(node);
    (parent ? scene.nodes[*parent].children : scene.roots).push_back(index);
    return index;
}

// A unit triangle under a moved parent, once by a node and twice by a batch.
Scene three_triangles() {
    Scene scene;
    Mesh mesh;
    mesh.name = "triangle";
    mesh.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
    mesh.wedge_vertex = {0, 1, 2};
    mesh.triangles = {0, 1, 2};
    mesh.triangle_slot = {0};
    mesh.slots.resize(1);
    scene.meshes = {mesh};
    const uint32_t parent = add_node(scene, {}, move_x(10));
    add_node(scene, parent, move_x(1), 0);
    scene.nodes[add_node(scene, parent, move_x(2), 0)].batch = {move_x(100), move_x(200)};
    return scene;
}

TEST(Instances, multiply_transforms_down_the_tree_and_through_batches) {
    const std::vector<Instance> all = instances(three_triangles());
    ASSERT_EQ(all.size(), 3);
    EXPECT_EQ(all[0].world, move_x(11));
    EXPECT_EQ(all[1].world, move_x(112));
    EXPECT_EQ(all[2].world, move_x(212));
    EXPECT_EQ(all[2].in_batch, 1);
    EXPECT_EQ(instance_count(three_triangles()), 3);
}

TEST(Instances, of_nodes_outside_the_default_scene_do_not_count) {
    Scene scene = three_triangles();
    scene.roots.clear();
    EXPECT_EQ(instance_count(scene), 0);
}

TEST(Instances, of_a_very_deep_tree_cost_no_stack) {
    Scene scene = three_triangles();
    uint32_t parent = 0;
    for (int depth = 0; depth < 200'000; ++depth) parent = add_node(scene, parent, move_x(1));
    add_node(scene, parent, {}, 0);
    EXPECT_EQ(instances(scene).back().world, move_x(200'010));
}

TEST(SceneBounds, are_those_of_all_instances) {
    const Bounds box = scene_bounds(three_triangles());
    EXPECT_EQ(box.min, (Vec3d{11, 0, 0}));
    EXPECT_EQ(box.max, (Vec3d{213, 1, 0}));
}

// Positions on a lattice, so that they are no box and no ball, placed as a hash of the index says.
TEST(SceneBounds, are_those_of_every_position_of_thousands_of_instances) {
    Scene scene = three_triangles();
    scene.nodes.clear();
    scene.roots.clear();
    scene.meshes[0].positions = {{0, 0, 0}, {3, 1, 0}, {0, 1, 2}, {-1, -2, 1}, {1, 1, -4}};
    uint32_t state = 1;
    const auto next = [&state] { return ((state = state * 1664525 + 1013904223) >> 8) / 16777216.0; };
    for (int i = 0; i < 5000; ++i)
        add_node(scene, {},
                 from_trs({10 * next(), 10 * next(), 0}, {next(), next(), next(), next()},
                          {1 + next(), 1 + next(), 1 + next()}),
                 0);
    Bounds exact;
    for (const Instance& instance : instances(scene))
        for (const Vec3f& position : scene.meshes[0].positions)
            exact.extend(instance.world.point(to_double(position)));
    const Bounds box = scene_bounds(scene);
    const double tolerance = 1e-9 * exact.diagonal();
    EXPECT_LE(length(box.min - exact.min), 2 * tolerance);
    EXPECT_LE(length(box.max - exact.max), 2 * tolerance);
}

Transform scale(double factor) {
    return from_trs({}, {0, 0, 0, 1}, {factor, factor, factor});
}

template <typename Body>
void expect_malformed(Body body, const std::string& where) {
    try {
        body();
        ADD_FAILURE() << "was not refused";
    } catch (const Error& error) {
        EXPECT_EQ(error.code(), ErrorCode::asset_malformed);
        EXPECT_EQ(error.where(), where);
    }
}

TEST(Instances, are_refused_where_finite_transforms_have_no_finite_product) {
    Scene scene = three_triangles();
    scene.nodes[0].local = scale(1e200);
    scene.nodes[1].local = scale(1e200);
    expect_malformed([&] { instances(scene); }, "nodes[1]");
    expect_malformed([&] { scene_bounds(scene); }, "nodes[1]");
    scene.nodes[1].local = {};
    scene.nodes[2].batch[1] = scale(1e200);
    expect_malformed([&] { instances(scene); }, "nodes[2]");
}

TEST(SceneBounds, are_refused_where_they_have_no_finite_diagonal) {
    Scene scene = three_triangles();
    for (const double factor : {1e200, 1e305}) {
        scene.nodes[0].local = scale(factor);
        scene.meshes[0].positions[1].x = 2;
        expect_malformed([&] { scene_bounds(scene); }, "nodes");
    }
    scene.nodes[0].local = scale(1e100);
    EXPECT_EQ(scene_bounds(scene).max.y, 1e100);
}

TEST(SceneBounds, look_at_the_stop_however_few_instances_have_however_many_positions) {
    Scene scene = three_triangles();
    scene.meshes[0].positions.resize(4 * watched_stride);
    size_t checks = 0;
    scene_bounds(scene, {.checked = [&checks] { ++checks; }});
    EXPECT_GE(checks, 8U) << "for how far the mesh reaches, and for the outermost instance";
}

TEST(UnfoldBatches, lists_the_same_instances_in_the_same_order) {
    Scene scene = three_triangles();
    add_node(scene, 2, move_x(5), 0);  // a child of the node with the batch
    const std::vector<Instance> before = instances(scene);
    unfold_batches(scene);
    const std::vector<Instance> after = instances(scene);
    ASSERT_EQ(after.size(), before.size());
    for (size_t i = 0; i < after.size(); ++i) EXPECT_EQ(after[i].world, before[i].world) << i;
}

TEST(ExpandMeshes, gives_each_instance_a_mesh_of_its_own_where_it_stood) {
    const Scene expanded = expand_meshes(three_triangles());
    const std::vector<Instance> all = instances(expanded);
    ASSERT_EQ(all.size(), 3);
    EXPECT_EQ(expanded.meshes.size(), 3);
    EXPECT_NE(all[0].mesh, all[1].mesh);
    EXPECT_NE(all[1].mesh, all[2].mesh);
    EXPECT_EQ(all[1].world, move_x(112));
}

TEST(BakeInstances, leaves_no_transform_and_the_same_bounds) {
    const Scene baked = bake_instances(three_triangles());
    EXPECT_EQ(baked.meshes.size(), 3);
    for (const Instance& instance : instances(baked)) EXPECT_EQ(instance.world, Transform{});
    EXPECT_EQ(scene_bounds(baked).max, scene_bounds(three_triangles()).max);
}

TEST(BakeInstances, turns_the_winding_of_mirrored_ones) {
    Scene scene = three_triangles();
    scene.nodes[1].local = from_trs({}, {0, 0, 0, 1}, {-1, 1, 1});
    const Mesh mesh = bake_instances(scene).meshes[0];
    const Vec3d a = mesh.corner_position(0, 0);
    EXPECT_GT(cross(mesh.corner_position(0, 1) - a, mesh.corner_position(0, 2) - a).z, 0);
}

}  // namespace
}  // namespace coppice
