#include "core/scene/remove_instances.h"

#include <gtest/gtest.h>

namespace coppice {
namespace {

Transform move_x(double x) {
    return from_trs({x, 0, 0}, {0, 0, 0, 1}, {1, 1, 1});
}

// A node with a child, and a batch of three.
Scene five_instances() {
    Scene scene;
    scene.meshes.resize(1);
    scene.nodes.push_back({.name = "above", .children = {1}, .local = move_x(1), .mesh = 0});
    scene.nodes.push_back({.name = "below", .parent = 0, .local = move_x(1), .mesh = 0});
    scene.nodes.push_back({.name = "batch", .mesh = 0, .batch = {move_x(10), move_x(20), move_x(30)}});
    scene.roots = {0, 2};
    return scene;
}

// Where those stand that are left when these are taken out.
std::vector<double> left_without(const std::vector<size_t>& gone) {
    Scene scene = five_instances();
    const std::vector<Instance> all = instances(scene);
    std::vector<Instance> picked;
    for (const size_t i : gone) picked.push_back(all[i]);
    remove_instances(scene, picked);
    std::vector<double> left;
    for (const Instance& instance : instances(scene)) left.push_back(instance.world.m[3]);
    return left;
}

TEST(RemoveInstances, takes_out_those_and_no_others) {
    EXPECT_EQ(left_without({}), (std::vector<double>{1, 2, 10, 20, 30}));
    EXPECT_EQ(left_without({1, 3}), (std::vector<double>{1, 10, 30}));
}

TEST(RemoveInstances, leaves_the_children_of_a_node_that_shows_nothing_any_more) {
    EXPECT_EQ(left_without({0}), (std::vector<double>{2, 10, 20, 30}));
}

TEST(RemoveInstances, leaves_nothing_of_a_batch_that_loses_all) {
    EXPECT_EQ(left_without({2, 3, 4}), (std::vector<double>{1, 2}));
    EXPECT_EQ(left_without({0, 1, 2, 3, 4}), std::vector<double>{});
}

}  // namespace
}  // namespace coppice
