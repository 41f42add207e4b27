#include "core/simplify/vt.h"

#include <gtest/gtest.h>

#include "tests/core/simplify/run_algorithm.h"
#include "tests/support/shapes.h"

namespace coppice {
namespace {

Simplified simplify(const Mesh& mesh, const Target& target, const test::Parameters& parameters = {}) {
    return test::run_algorithm(vt(), mesh, target, parameters);
}

const Mesh& ball() {
    static const Mesh mesh = shapes::blob({.segments = 60, .rings = 40, .uvs = false});
    return mesh;
}

TEST(Vt, takes_four_triangles_for_each_that_merges) {
    const Simplified s = simplify(ball(), {}, {{"passes", 1.0}});
    EXPECT_EQ(s.stop_reason, StopReason::threshold);
    EXPECT_EQ((ball().triangle_count() - s.mesh.triangle_count()) % 4, 0U);
    EXPECT_LT(s.mesh.triangle_count(), ball().triangle_count() * 6 / 10);
    EXPECT_GT(s.mesh.triangle_count(), ball().triangle_count() * 4 / 10);
}

TEST(Vt, merges_no_triangle_with_a_longer_edge) {
    const Simplified none = simplify(ball(), {.triangles = 100}, {{"max_edge", "0.0001u"}});
    EXPECT_EQ(none.stop_reason, StopReason::threshold);
    EXPECT_EQ(none.mesh.triangle_count(), ball().triangle_count());
}

TEST(Vt, goes_further_in_more_passes) {
    const size_t once = simplify(ball(), {}, {{"passes", 1.0}}).mesh.triangle_count();
    const size_t thrice = simplify(ball(), {}, {{"passes", 3.0}}).mesh.triangle_count();
    EXPECT_LT(thrice, once / 2);
}

TEST(Vt, tells_the_threshold_that_gives_the_same) {
    const Target half = {.triangles = ball().triangle_count() / 2};
    const Simplified found = simplify(ball(), half);
    ASSERT_TRUE(found.threshold_used);
    const Simplified given =
        simplify(ball(), half, {{"max_edge", std::to_string(*found.threshold_used * 1.0001) + "u"}});
    EXPECT_EQ(given.stop_reason, StopReason::target);
    EXPECT_EQ(given.mesh.triangle_count(), found.mesh.triangle_count());
}

}  // namespace
}  // namespace coppice
