#include "core/simplify/ss.h"

#include <gtest/gtest.h>

#include "tests/core/simplify/run_algorithm.h"
#include "tests/support/shapes.h"

namespace coppice {
namespace {

Simplified simplify(const Mesh& mesh, const Target& target, const test::Parameters& parameters = {}) {
    return test::run_algorithm(ss(), mesh, target, parameters);
}

const Mesh& ball() {
    static const Mesh mesh = shapes::blob({.segments = 60, .rings = 40, .uvs = false});
    return mesh;
}

// Two sheets, one close above the other and facing away from it.
Mesh two_sheets() {
    Mesh mesh = shapes::grid({.columns = 10, .rows = 10});
    const auto vertices = static_cast<uint32_t>(mesh.vertex_count());
    const size_t corners = mesh.triangles.size();
    for (uint32_t v = 0; v < vertices; ++v) {
        Vec3f p = mesh.positions[v];
        p.y -= 0.01F;
        mesh.positions.push_back(p);
        mesh.wedge_vertex.push_back(vertices + v);
    }
    for (size_t c = 0; c < corners; c += 3)
        for (const size_t k : {0U, 2U, 1U}) mesh.triangles.push_back(mesh.triangles[c + k] + vertices);
    mesh.triangle_slot.resize(mesh.triangles.size() / 3);
    return mesh;
}

size_t on_the_upper_sheet(const Mesh& mesh) {
    size_t count = 0;
    for (const Vec3f p : mesh.positions) count += p.y == 0 ? 1 : 0;
    return count;
}

TEST(Ss, removes_more_with_larger_balls) {
    size_t last = ball().triangle_count();
    for (const double radius : {0.5, 0.8, 1.2, 2.0}) {
        const Simplified s = simplify(ball(), {}, {{"radius", radius}});
        EXPECT_LT(s.mesh.triangle_count(), last) << radius;
        last = s.mesh.triangle_count();
    }
}

TEST(Ss, does_not_fuse_sheets_that_only_lie_close) {
    const Mesh connected = simplify(two_sheets(), {}, {{"radius", "0.05u"}}).mesh;
    EXPECT_EQ(on_the_upper_sheet(connected), connected.vertex_count() / 2);
    const Mesh fused = simplify(two_sheets(), {}, {{"radius", "0.05u"}, {"neighborhood", "euclidean"}}).mesh;
    EXPECT_EQ(on_the_upper_sheet(fused), 0U);
}

TEST(Ss, merges_whatever_is_in_the_ball_as_printed) {
    const Simplified s = simplify(ball(), {}, {{"radius", 100.0}, {"neighborhood", "euclidean"}});
    EXPECT_EQ(s.mesh.triangle_count(), 0U);
}

TEST(Ss, goes_further_in_more_passes) {
    const auto left = [](double passes) {
        return simplify(ball(), {}, {{"radius", 0.9}, {"passes", passes}}).mesh.triangle_count();
    };
    EXPECT_LT(left(4), left(1));
}

TEST(Ss, meets_small_targets_by_search) {
    const Simplified s = simplify(ball(), {.triangles = ball().triangle_count() / 20});
    EXPECT_EQ(s.stop_reason, StopReason::target);
    EXPECT_GT(*s.threshold_used, 0);
}

}  // namespace
}  // namespace coppice
