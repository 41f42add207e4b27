#include "core/simplify/surface_angle.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "core/mesh/adjacency.h"
#include "core/simplify/collapse_rules.h"
#include "tests/core/simplify/run_algorithm.h"
#include "tests/support/properties.h"
#include "tests/support/shapes.h"

namespace coppice {
namespace {

Simplified simplify(const Mesh& mesh, const Target& target, const test::Parameters& parameters = {}) {
    return test::run_algorithm(surface_angle(), mesh, target, parameters);
}

const Mesh& ball() {
    static const Mesh mesh = shapes::blob({.segments = 60, .rings = 40, .uvs = false});
    return mesh;
}

size_t left_at(double angle, const std::map<std::string, ParameterValue>& parameters = {}) {
    std::map<std::string, ParameterValue> all = parameters;
    all["angle"] = angle;
    return simplify(ball(), {}, all).mesh.triangle_count();
}

TEST(SurfaceAngle, removes_less_at_larger_angles) {
    size_t last = 0;
    for (const double angle : {30.0, 150.0, 170.0, 174.0, 178.0}) {
        const size_t left = left_at(angle);
        EXPECT_GE(left, last) << angle;
        last = left;
    }
    EXPECT_GT(last, left_at(150));
    EXPECT_EQ(left_at(180), ball().triangle_count());
}

TEST(SurfaceAngle, takes_two_triangles_with_a_vertex) {
    const Mesh left = simplify(ball(), {}, {{"angle", 165.0}}).mesh;
    EXPECT_LT(left.vertex_count(), ball().vertex_count());
    EXPECT_EQ(ball().triangle_count() - left.triangle_count(),
              2 * (ball().vertex_count() - left.vertex_count()));
}

TEST(SurfaceAngle, asks_more_of_all_pairs_and_less_of_a_few) {
    EXPECT_GT(left_at(172, {{"pairs", "all"}}), left_at(172));
    EXPECT_LT(left_at(172, {{"count", 3.0}}), left_at(172));
    EXPECT_EQ(left_at(172, {{"count", "9999"}}), left_at(172));
}

TEST(SurfaceAngle, moves_nothing_and_keeps_values) {
    const Mesh hills = shapes::grid({.height = 0.1, .normals = true, .uvs = true});
    const Mesh left = simplify(hills, {.triangles = hills.triangle_count() / 2}).mesh;
    for (const Vec3f p : left.positions)
        EXPECT_NE(std::find(hills.positions.begin(), hills.positions.end(), p), hills.positions.end());
    EXPECT_TRUE(test::keeps_charts(hills, left));
}

size_t border_edges(const Mesh& mesh) {
    return topology(mesh).border_edges;
}

TEST(SurfaceAngle, leaves_borders_alone_unless_told_else) {
    const Mesh sheet = shapes::grid();
    const Simplified kept = simplify(sheet, {.triangles = 2});
    EXPECT_EQ(border_edges(kept.mesh), border_edges(sheet));
    EXPECT_NE(kept.stop_reason, StopReason::target);
    const Simplified removed = simplify(sheet, {.triangles = 2}, {{"borders", "remove"}});
    EXPECT_EQ(removed.mesh.triangle_count(), 2U);
    EXPECT_EQ(removed.stop_reason, StopReason::target);
    EXPECT_TRUE(test::keeps_borders(sheet, removed.mesh, 1e-6));
}

TEST(SurfaceAngle, keeps_a_border_that_turns_however_many_angles_count) {
    // A flat strip, whose borders go to and fro.
    Mesh strip;
    strip.slots.push_back({});
    for (uint32_t i = 0; i < 100; ++i) {
        const float side = i % 2 == 0 ? 0.1F : -0.1F;
        for (const float z : {0.0F, 1.0F, 2.0F}) {
            strip.wedge_vertex.push_back(static_cast<uint32_t>(strip.positions.size()));
            strip.positions.push_back({static_cast<float>(i), z == 1 ? 0 : side, 0});
            strip.positions.back().y += z;
        }
        for (const uint32_t low : {3 * i, 3 * i + 1}) {
            if (i == 99) break;
            strip.triangles.insert(strip.triangles.end(), {low, low + 3, low + 1, low + 1, low + 3, low + 4});
            strip.triangle_slot.insert(strip.triangle_slot.end(), 2, 0);
        }
    }
    const auto left = [&](const char* count) {
        return simplify(strip, {}, {{"angle", 175.0}, {"borders", "remove"}, {"count", count}})
            .mesh.triangles;
    };
    EXPECT_EQ(left("9999"), left("all"));
}

// Each of `slices` triangles around a hub is three, around a vertex whose ring begins with the hub.
TEST(SurfaceAngle, searches_no_hub_for_a_triangle) {
    constexpr uint32_t slices = 4096;
    Mesh disc;
    disc.slots.push_back({});
    disc.positions.push_back({0, 0, 0});
    for (const double radius : {1.0, 0.8}) {
        for (uint32_t i = 0; i < slices; ++i) {
            const double angle = 2 * 3.14159265358979 * (i + (radius < 1 ? 0.5 : 0)) / slices;
            disc.positions.push_back(to_float({radius * std::cos(angle), radius * std::sin(angle), 0}));
        }
    }
    for (uint32_t v = 0; v < disc.vertex_count(); ++v) disc.wedge_vertex.push_back(v);
    for (uint32_t i = 0; i < slices; ++i) {
        const uint32_t a = 1 + i, b = 1 + (i + 1) % slices, middle = 1 + slices + i;
        disc.triangles.insert(disc.triangles.end(), {middle, a, b, middle, b, 0, middle, 0, a});
        disc.triangle_slot.insert(disc.triangle_slot.end(), 3, 0);
    }
    const CollapseMesh collapsing(disc);
    CollapseRules rules(collapsing, find_features(collapsing, {}).kinds);
    for (uint32_t i = 0; i < slices; ++i)
        EXPECT_FALSE(rules.has_triangle({0, 1 + i, 1 + (i + 1) % slices})) << i;
    EXPECT_LT(rules.searched(), 20 * slices);
    const Simplified left = simplify(disc, {.triangles = slices});
    EXPECT_EQ(left.mesh.triangle_count(), slices);
}

TEST(SurfaceAngle, takes_vertices_of_a_seam_on_both_sides) {
    const Mesh pipe = shapes::cylinder();
    const Mesh left = simplify(pipe, {.triangles = pipe.triangle_count() / 3}, {{"borders", "remove"}}).mesh;
    EXPECT_LT(left.triangle_count(), pipe.triangle_count() / 2);
    EXPECT_TRUE(test::keeps_seams(pipe, left, 0.05));
    EXPECT_TRUE(test::keeps_charts(pipe, left));
}

// A vertex on an edge of a box goes without cutting the edge off.
TEST(SurfaceAngle, runs_creases_on) {
    const Mesh box = shapes::box({.cells = 4, .faceted = false});
    const Simplified s = simplify(box, {.triangles = 12});
    EXPECT_EQ(s.stop_reason, StopReason::target);
    EXPECT_EQ(s.mesh.triangle_count(), 12U);
    EXPECT_LT(s.error_model_units, 1e-6);
}

TEST(SurfaceAngle, returns_what_it_cannot_treat_and_says_why) {
    const Mesh solid = shapes::tetrahedron();
    const Simplified whole = simplify(solid, {.triangles = 2});
    EXPECT_EQ(whole.stop_reason, StopReason::bounds);
    EXPECT_EQ(whole.mesh.triangles, solid.triangles);
    const Mesh strip = shapes::grid({.columns = 10, .rows = 1});  // nothing but border
    const Simplified same = simplify(strip, {.triangles = 2});
    EXPECT_EQ(same.stop_reason, StopReason::locked);
    EXPECT_EQ(same.mesh.triangles, strip.triangles);
}

// Two triangles, each of a material of its own: neither may go with its only free vertex.
TEST(SurfaceAngle, drops_no_material) {
    Mesh sheet = shapes::grid({.columns = 1, .rows = 1});
    sheet.slots.push_back({.material = 1});
    sheet.triangle_slot = {0, 1};
    std::vector<int> uses(4);
    for (const uint32_t wedge : sheet.triangles) ++uses[sheet.wedge_vertex[wedge]];
    const auto free = static_cast<size_t>(std::find(uses.begin(), uses.end(), 1) - uses.begin());
    const Vec3f p = sheet.positions[free];  // one of them so thin that its border is nearly straight
    sheet.positions[free] = {0.5F + 0.02F * (p.x - 0.5F), 0, 0.5F + 0.02F * (p.z - 0.5F)};
    const Simplified same = simplify(sheet, {.triangles = 1}, {{"borders", "remove"}});
    EXPECT_EQ(same.mesh.triangle_count(), 2U);
    EXPECT_NE(same.stop_reason, StopReason::target);
}

TEST(SurfaceAngle, finds_its_angle_by_search_and_stays_within_one_given) {
    const Target half = {.triangles = ball().triangle_count() / 2};
    const Simplified found = simplify(ball(), half);
    EXPECT_EQ(found.stop_reason, StopReason::target);
    ASSERT_TRUE(found.threshold_used);
    EXPECT_GT(*found.threshold_used, 90);
    EXPECT_LT(*found.threshold_used, 180);
    const Simplified kept = simplify(ball(), half, {{"angle", 178.0}});
    EXPECT_EQ(kept.stop_reason, StopReason::threshold);
    EXPECT_GE(*kept.threshold_used, 178 - 1e-9);
    EXPECT_GT(kept.mesh.triangle_count(), *half.triangles);
}

TEST(SurfaceAngle, stops_at_an_error) {
    const Simplified s = simplify(ball(), {.error_model_units = 0.002});
    EXPECT_EQ(s.stop_reason, StopReason::error_limit);
    EXPECT_LE(s.error_model_units, 0.002);
    EXPECT_LT(s.mesh.triangle_count(), ball().triangle_count());
}

TEST(SurfaceAngle, stitches_one_triangle_too_many_as_printed) {
    const Mesh left = simplify(ball(), {}, {{"angle", 165.0}, {"stitch", "paper"}}).mesh;
    EXPECT_LT(left.vertex_count(), ball().vertex_count());
    EXPECT_EQ(ball().triangle_count() - left.triangle_count(), ball().vertex_count() - left.vertex_count());
}

}  // namespace
}  // namespace coppice
