#include "core/simplify/instance_pruning.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>

#include "core/simplify/ias.h"
#include "tests/support/shapes.h"

namespace coppice {
namespace {

// In a square, a unit apart.
std::vector<Transform> field(size_t side) {
    std::vector<Transform> places;
    for (size_t i = 0; i < side * side; ++i) {
        const auto column = i % side, row = i / side;
        places.push_back(
            from_trs({static_cast<double>(column), 0, static_cast<double>(row)}, {0, 0, 0, 1}, {1, 1, 1}));
    }
    return places;
}

using Parameters = std::map<std::string, ParameterValue>;

// Tetrahedra, of which nothing can be taken away.
SimplifiedScene simplify(const std::vector<std::vector<Transform>>& instances, uint64_t triangles,
                         const Parameters& parameters = {{"prune_instances", true}}) {
    const std::vector<Mesh> meshes(instances.size(), shapes::tetrahedron());
    const SceneTarget target = {.triangles = triangles, .of_mesh = std::vector<Target>(meshes.size())};
    const auto values = ParameterValues::parse(ias().parameters, parameters);
    return ias().simplify_scene(meshes, instances, target, values, {});
}

TEST(InstancePruning, is_off_unless_asked_for) {
    const SimplifiedScene scene = simplify({field(40)}, 1600, {});
    EXPECT_TRUE(scene.dropped_instances.empty());
    EXPECT_EQ(scene.meshes[0].mesh.positions, shapes::tetrahedron().positions);
}

TEST(InstancePruning, drops_as_many_as_the_target_takes) {
    const SimplifiedScene scene = simplify({field(40)}, 4 * 700 + 3);
    EXPECT_EQ(scene.dropped_instances[0].size(), 900U);
    EXPECT_EQ(scene.meshes[0].stop_reason, StopReason::target);
}

TEST(InstancePruning, drops_none_where_collapses_meet_the_target) {
    EXPECT_TRUE(simplify({field(40)}, 4 * 1600).dropped_instances.empty());
}

TEST(InstancePruning, drops_the_same_with_the_same_seed_and_others_with_another) {
    const auto dropped = [](double seed) {
        return simplify({field(40)}, 3200, {{"prune_instances", true}, {"seed", seed}}).dropped_instances;
    };
    EXPECT_EQ(dropped(1), simplify({field(40)}, 3200).dropped_instances);
    EXPECT_NE(dropped(1), dropped(2));
}

TEST(InstancePruning, names_each_instance_once_in_order) {
    const auto dropped = simplify({field(40)}, 3200).dropped_instances[0];
    EXPECT_TRUE(std::is_sorted(dropped.begin(), dropped.end()));
    EXPECT_EQ(std::set(dropped.begin(), dropped.end()).size(), dropped.size());
    EXPECT_LT(dropped.back(), 1600U);
}

TEST(InstancePruning, enlarges_what_stays_so_that_it_covers_what_all_did) {
    const Simplified result = simplify({field(40)}, 1600).meshes[0];  // a quarter stays
    double farthest = 0;
    for (size_t v = 0; v < result.mesh.vertex_count(); ++v) {
        const Vec3d was = to_double(shapes::tetrahedron().positions[v]);
        EXPECT_NEAR(length(to_double(result.mesh.positions[v]) - was * 2), 0, 1e-6);
        farthest = std::max(farthest, length(was));
    }
    EXPECT_NEAR(result.error_model_units, farthest, 1e-6) << "what moves by its distance from the origin";
}

TEST(InstancePruning, leaves_alone_what_stands_rarely) {
    const SimplifiedScene scene = simplify({field(40), field(31)}, 3000);
    EXPECT_FALSE(scene.dropped_instances[0].empty());
    EXPECT_TRUE(scene.dropped_instances[1].empty()) << "961 instances";
    const SimplifiedScene part = simplify({field(150), field(33)}, 50'000);
    EXPECT_FALSE(part.dropped_instances[0].empty());
    EXPECT_TRUE(part.dropped_instances[1].empty()) << "1089 of 23589 instances";
}

TEST(InstancePruning, takes_the_same_share_of_each_that_stands_often) {
    const SimplifiedScene scene = simplify({field(40), field(60)}, 4 * (800 + 1800));
    EXPECT_EQ(scene.dropped_instances[0].size(), 800U);
    EXPECT_EQ(scene.dropped_instances[1].size(), 1800U);
}

TEST(InstancePruning, keeps_one_of_each_and_says_that_the_target_was_not_met) {
    const SimplifiedScene scene = simplify({field(40), field(31)}, 1);
    EXPECT_EQ(scene.dropped_instances[0].size(), 1599U);
    EXPECT_NE(scene.meshes[0].stop_reason, StopReason::target);
}

// A tetrahedron at the rim of the field reaches out of its box when it grows.
TEST(InstancePruning, drops_first_what_would_leave_the_box_of_the_scene) {
    const size_t side = 100;
    std::vector<std::vector<Transform>> instances = {field(side)};
    instances.push_back({from_trs({50, -50, 50}, {0, 0, 0, 1}, {1, 200, 1})});  // a mast: the box is high
    const auto dropped = simplify(instances, 4 * 9000).dropped_instances[0];
    const std::set<uint32_t> gone(dropped.begin(), dropped.end());
    for (uint32_t i = 0; i < side; ++i) EXPECT_TRUE(gone.contains(i + side * (side - 1))) << i;
}

TEST(InstancePruning, spares_what_would_outgrow_numbers) {
    Mesh mesh = shapes::tetrahedron();
    for (Vec3f& p : mesh.positions) p = to_float(to_double(p) * 1e37);
    std::vector<Simplified> results = {{.mesh = mesh}};
    const std::vector<std::vector<Transform>> instances = {field(40)};
    EXPECT_TRUE(prune_instances(results, instances, {.rendered_triangles = 400}, {})[0].empty());
    EXPECT_EQ(results[0].mesh.positions, mesh.positions);
}

TEST(InstancePruning, spares_what_bends) {
    Mesh mesh = shapes::tetrahedron();
    mesh.attributes.push_back(
        {.name = "JOINTS_0", .components = 4, .values = std::vector<float>(4 * mesh.wedge_count())});
    std::vector<Simplified> results = {{.mesh = mesh}};
    const std::vector<std::vector<Transform>> instances = {field(40)};
    EXPECT_TRUE(prune_instances(results, instances, {.rendered_triangles = 1}, {})[0].empty());
    EXPECT_EQ(results[0].mesh.positions, mesh.positions);
}

}  // namespace
}  // namespace coppice
