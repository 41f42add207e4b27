#include "core/simplify/fad.h"

#include <gtest/gtest.h>

#include "core/mesh/adjacency.h"
#include "tests/core/simplify/run_algorithm.h"
#include "tests/support/properties.h"
#include "tests/support/shapes.h"

namespace coppice {
namespace {

Simplified simplify(const Mesh& mesh, const Target& target, const test::Parameters& parameters = {}) {
    return test::run_algorithm(fad(), mesh, target, parameters);
}

const Mesh& ball() {
    static const Mesh mesh = shapes::blob({.segments = 60, .rings = 40, .uvs = false});
    return mesh;
}

TEST(Fad, takes_exactly_two_triangles_with_a_vertex) {
    for (const double angle : {175.0, 165.0, 150.0, 120.0}) {
        const Mesh left = simplify(ball(), {}, {{"angle", angle}}).mesh;
        EXPECT_LT(left.vertex_count(), ball().vertex_count());
        EXPECT_EQ(ball().triangle_count() - left.triangle_count(),
                  2 * (ball().vertex_count() - left.vertex_count()))
            << angle;
    }
}

TEST(Fad, removes_until_nothing_is_left_to_remove) {
    const Simplified once = simplify(ball(), {}, {{"angle", 165.0}});
    EXPECT_EQ(once.stop_reason, StopReason::threshold);
    EXPECT_EQ(*once.threshold_used, 165);
    // The flips at the end open a few more.
    const Simplified again = simplify(once.mesh, {}, {{"angle", 165.0}});
    EXPECT_GT(again.mesh.triangle_count(), 0.9 * static_cast<double>(once.mesh.triangle_count()));
    EXPECT_LT(once.mesh.triangle_count(), 0.6 * static_cast<double>(ball().triangle_count()));
}

TEST(Fad, leaves_vertices_with_large_triangles) {
    // Two halves, one with squares ten times as wide as the other's.
    Mesh sheet = shapes::grid({.columns = 16, .rows = 16});
    for (Vec3f& p : sheet.positions)
        if (p.x > 0.5F) p.x = 0.5F + 10 * (p.x - 0.5F);
    const auto inside = [](const Mesh& mesh, bool wide) {
        size_t count = 0;
        for (const Vec3f p : mesh.positions) {
            const bool is_wide = p.x > 0.5F;
            count += is_wide == wide && p.x > 0 && p.x < 5.5F && p.z > 0 && p.z < 1 ? 1 : 0;
        }
        return count;
    };
    const Mesh all = simplify(sheet, {}, {{"angle", 150.0}}).mesh;
    EXPECT_EQ(inside(all, true), 0U);
    const Mesh some = simplify(sheet, {}, {{"angle", 150.0}, {"area_limit", 1.0}}).mesh;
    EXPECT_EQ(inside(some, true), inside(sheet, true));
    EXPECT_LT(inside(some, false), inside(sheet, false) / 2);
}

TEST(Fad, straightens_no_border_that_turns) {
    const Mesh sheet = shapes::grid();
    const Mesh left = simplify(sheet, {}, {{"angle", 150.0}}).mesh;
    EXPECT_EQ(left.triangle_count(), 2U);
    EXPECT_TRUE(test::keeps_borders(sheet, left, 1e-6));
}

TEST(Fad, compares_any_two_triangles_of_a_vertex_by_default) {
    const auto left = [](const char* pairs) {
        return simplify(ball(), {}, {{"angle", 172.0}, {"pairs", pairs}}).mesh.triangle_count();
    };
    EXPECT_GT(left("all"), left("adjacent"));
}

TEST(Fad, meets_small_targets_by_search) {
    const Simplified s = simplify(ball(), {.triangles = ball().triangle_count() / 20});
    EXPECT_EQ(s.stop_reason, StopReason::target);
    EXPECT_LT(*s.threshold_used, 180);
}

}  // namespace
}  // namespace coppice
