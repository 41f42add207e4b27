// Borders and seams stay near where they were, whatever is asked.
#include <gtest/gtest.h>

#include "core/simplify/registry.h"
#include "tests/core/simplify/run_algorithm.h"
#include "tests/support/properties.h"
#include "tests/support/shapes.h"

namespace coppice {
namespace {

Simplified simplify(const Mesh& mesh, uint64_t triangles) {
    return test::run_algorithm(find_algorithm("its"), mesh, {.triangles = triangles});
}

TEST(LineGuard, keeps_the_corners_of_a_square_sheet) {
    const Simplified result = simplify(shapes::grid({.columns = 1, .rows = 1}), 1);
    EXPECT_EQ(result.mesh.triangle_count(), 2U);
    EXPECT_EQ(result.stop_reason, StopReason::topology);
}

TEST(LineGuard, lets_straight_borders_go_down_to_their_corners) {
    const Mesh sheet = shapes::grid();
    const Simplified result = simplify(sheet, 1);
    EXPECT_EQ(result.mesh.triangle_count(), 2U);
    EXPECT_TRUE(test::keeps_borders(sheet, result.mesh, 1e-6));
}

TEST(LineGuard, limits_many_small_steps_together) {
    // Each of the rim's 64 vertices is only 0.001 of the diagonal off the chord of its neighbours.
    const Mesh pipe = shapes::cylinder({.segments = 64, .rows = 4, .seam = false});
    const Simplified result = simplify(pipe, 1);
    EXPECT_TRUE(test::keeps_borders(pipe, result.mesh, 0.05));
    EXPECT_LT(result.mesh.triangle_count(), 40U);
}

}  // namespace
}  // namespace coppice
