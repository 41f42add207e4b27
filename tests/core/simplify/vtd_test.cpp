#include "core/simplify/vtd.h"

#include <gtest/gtest.h>

#include "tests/core/simplify/run_algorithm.h"
#include "tests/support/shapes.h"

namespace coppice {
namespace {

Simplified simplify(const Mesh& mesh, const Target& target, const test::Parameters& parameters = {}) {
    return test::run_algorithm(vtd(), mesh, target, parameters);
}

// One triangle 1 2 3 with edges 12 of 1, 23 of 1.4, 13 of 1.6, in a sheet whose others are longer than 10.
Mesh triangle() {
    Mesh mesh;
    mesh.positions = {{0, 0, 0}, {1, 0, 0}, {0.8F, 1.3856F, 0}};
    mesh.wedge_vertex = {0, 1, 2};
    mesh.triangles = {0, 1, 2};
    mesh.triangle_slot = {0};
    mesh.slots.resize(1);
    return mesh;
}

TEST(Vtd, as_printed_merges_the_longer_edge_beside_the_short_one) {
    // All that is left of one triangle is nothing, so its two neighbours tell: they hold on to 2 and to 1 3.
    Mesh mesh = triangle();
    mesh.positions.push_back({30, 5, 0});   // 3, beyond edge 23
    mesh.positions.push_back({-30, 9, 0});  // 4, beyond edge 13
    mesh.wedge_vertex = {0, 1, 2, 3, 4};
    mesh.triangles = {0, 1, 2, 1, 3, 2, 0, 2, 4};
    mesh.triangle_slot = {0, 0, 0};
    const Simplified printed = simplify(mesh, {}, {{"distance", "1.1u"}, {"rule", "paper"}});
    ASSERT_EQ(printed.mesh.triangle_count(), 1U);  // 1 3 became one: the triangle beyond 23 is left
    EXPECT_FLOAT_EQ(printed.mesh.positions[0].x, 0.4F);
    const Simplified capped = simplify(mesh, {}, {{"distance", "0.79u"}, {"rule", "paper"}});
    EXPECT_EQ(capped.mesh.triangle_count(), 3U);
}

TEST(Vtd, by_default_merges_the_shortest_edge) {
    const Mesh ball = shapes::blob({.segments = 60, .rings = 40, .uvs = false});
    const Simplified s = simplify(ball, {}, {{"distance", 0.6}});
    EXPECT_EQ(s.stop_reason, StopReason::threshold);
    EXPECT_LT(s.mesh.triangle_count(), ball.triangle_count());
    EXPECT_EQ(s.mesh.triangle_count() % 2, 0U);
}

TEST(Vtd, meets_a_target_by_search) {
    const Mesh ball = shapes::blob({.segments = 60, .rings = 40, .uvs = false});
    const Simplified s = simplify(ball, {.triangles = ball.triangle_count() / 2});
    EXPECT_EQ(s.stop_reason, StopReason::target);
    EXPECT_TRUE(s.threshold_used);
}

}  // namespace
}  // namespace coppice
