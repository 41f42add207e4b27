#include "core/simplify/ivdd.h"

#include <gtest/gtest.h>

#include "core/simplify/mean_edge.h"
#include "tests/core/simplify/run_algorithm.h"
#include "tests/support/shapes.h"

namespace coppice {
namespace {

Simplified simplify(const Mesh& mesh, const Target& target, const test::Parameters& parameters = {}) {
    return test::run_algorithm(ivdd(), mesh, target, parameters);
}

const Mesh& ball() {
    static const Mesh mesh = shapes::blob({.segments = 60, .rings = 40, .uvs = false});
    return mesh;
}

TEST(Ivdd, removes_more_at_larger_distances) {
    size_t last = ball().triangle_count();
    for (const double distance : {0.5, 0.8, 1.1}) {
        const Simplified s = simplify(ball(), {}, {{"distance", distance}});
        EXPECT_EQ(s.stop_reason, StopReason::threshold);
        EXPECT_LT(s.mesh.triangle_count(), last);
        last = s.mesh.triangle_count();
    }
}

TEST(Ivdd, moves_no_vertex_by_the_distance_when_each_is_merged_once) {
    const Simplified s = simplify(ball(), {}, {{"distance", 1.0}});
    EXPECT_GT(s.error_model_units, 0);
    EXPECT_LT(s.error_model_units, mean_edge(ball()));
}

TEST(Ivdd, goes_further_where_merged_vertices_merge_again) {
    const auto left = [](const char* mode) {
        return simplify(ball(), {}, {{"distance", 1.0}, {"mode", mode}, {"circumcenter", "paper"}})
            .mesh.triangle_count();
    };
    EXPECT_LT(left("sequential"), left("once"));
}

TEST(Ivdd, finds_a_distance_for_a_target_and_stays_inside_one_that_is_given) {
    const Target half = {.triangles = ball().triangle_count() / 2};
    const Simplified found = simplify(ball(), half);
    EXPECT_EQ(found.stop_reason, StopReason::target);
    ASSERT_TRUE(found.threshold_used);
    EXPECT_GT(*found.threshold_used, 0);
    const Simplified kept =
        simplify(ball(), half, {{"distance", std::to_string(*found.threshold_used / 2) + "u"}});
    EXPECT_EQ(kept.stop_reason, StopReason::threshold);
    EXPECT_LE(*kept.threshold_used, *found.threshold_used / 2 + 1e-6);
    EXPECT_GT(kept.mesh.triangle_count(), found.mesh.triangle_count());
}

}  // namespace
}  // namespace coppice
