// The checks of tests/support/properties.h each fail on what they are there to catch.
#include "tests/support/properties.h"

#include <fmt/core.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/simplify/registry.h"
#include "tests/support/shapes.h"

namespace coppice::test {
namespace {

// size x size quads in the plane z = 0, normals up; the texture is cut along the column `seam`, if any.
Mesh sheet(uint32_t size, std::optional<uint32_t> seam = {}) {
    Mesh mesh;
    mesh.slots.resize(1);
    Attribute uv = {.name = "TEXCOORD_0", .components = 2};
    std::vector<std::array<uint32_t, 2>> wedges;  // left and right of a seam at the vertex
    for (uint32_t y = 0; y <= size; ++y)
        for (uint32_t x = 0; x <= size; ++x) {
            const auto vertex = static_cast<uint32_t>(mesh.positions.size());
            mesh.positions.push_back({static_cast<float>(x), static_cast<float>(y), 0});
            std::array<uint32_t, 2> both{};
            for (uint32_t side = 0; side < 2; ++side) {
                if (side == 1 && seam != x) {
                    both[1] = both[0];
                    continue;
                }
                both[side] = static_cast<uint32_t>(mesh.wedge_vertex.size());
                mesh.wedge_vertex.push_back(vertex);
                const float shift = seam && (x > *seam || (x == *seam && side == 1)) ? 100.0F : 0.0F;
                uv.values.insert(uv.values.end(), {static_cast<float>(x) + shift, static_cast<float>(y)});
            }
            wedges.push_back(both);
        }
    mesh.attributes.push_back(uv);
    for (uint32_t y = 0; y < size; ++y)
        for (uint32_t x = 0; x < size; ++x) {
            const uint32_t i = y * (size + 1) + x;
            const uint32_t a = wedges[i][1];
            const uint32_t b = wedges[i + 1][0];
            const uint32_t c = wedges[i + size + 2][0];
            const uint32_t d = wedges[i + size + 1][1];
            mesh.triangles.insert(mesh.triangles.end(), {a, b, c, a, c, d});
            mesh.triangle_slot.insert(mesh.triangle_slot.end(), {0, 0});
        }
    return mesh;
}

void drop_triangle(Mesh& mesh, size_t triangle) {
    const auto at = static_cast<std::ptrdiff_t>(triangle);
    mesh.triangles.erase(mesh.triangles.begin() + 3 * at, mesh.triangles.begin() + 3 * at + 3);
    mesh.triangle_slot.erase(mesh.triangle_slot.begin() + at);
}

void add_triangle(Mesh& mesh, uint32_t a, uint32_t b, uint32_t c) {
    mesh.triangles.insert(mesh.triangles.end(), {a, b, c});
    mesh.triangle_slot.push_back(0);
}

// A mesh at each of the given x.
Scene row_of(const Mesh& mesh, const std::vector<double>& places) {
    Scene scene;
    scene.meshes.push_back(mesh);
    for (const double x : places) {
        Node node;
        node.local.m[3] = x;
        node.mesh = 0;
        scene.roots.push_back(static_cast<uint32_t>(scene.nodes.size()));
        scene.nodes.push_back(node);
    }
    return scene;
}

Report report_of(uint64_t in, uint64_t out, StopReason reason) {
    Report report;
    report.meshes.push_back(
        {.name = "sheet", .triangles_in = in, .triangles_out = out, .stop_reason = reason});
    return report;
}

TEST(Properties, hold_for_an_unchanged_scene) {
    const Scene scene = row_of(sheet(4, 2), {0, 10, 20});
    expect_properties_kept(scene, scene, report_of(32, 32, StopReason::target), 1.0);
}

TEST(Properties, notice_an_instance_that_is_missing_or_moved) {
    const Scene before = row_of(sheet(2), {0, 10, 20});
    EXPECT_FALSE(keeps_instances(before, row_of(sheet(2), {0, 10})));
    EXPECT_FALSE(keeps_instances(before, row_of(sheet(2), {0, 10.01, 20})));
}

TEST(Properties, notice_instances_that_no_longer_share_their_mesh) {
    const Scene before = row_of(sheet(2), {0, 10});
    Scene after = before;
    after.meshes.push_back(after.meshes[0]);
    EXPECT_FALSE(keeps_instances(before, after)) << "more unique meshes";
    after.nodes[1].mesh = 1;
    EXPECT_FALSE(keeps_instances(before, after)) << "no longer shared";
}

TEST(Properties, notice_bounds_that_shrink) {
    const Scene before = row_of(sheet(4), {0});
    Scene after = before;
    for (Vec3f& p : after.meshes[0].positions) p.x = std::min(p.x, 3.9F);
    EXPECT_TRUE(keeps_bounds(before, after, 0.02));
    EXPECT_FALSE(keeps_bounds(before, after, 0.01));
}

TEST(Properties, notice_a_missed_target_without_a_reason) {
    const Scene after = row_of(sheet(4), {0});  // 32 triangles
    EXPECT_TRUE(meets_target(report_of(64, 32, StopReason::target), after, 0.5));
    EXPECT_FALSE(meets_target(report_of(64, 32, StopReason::target), after, 0.4)) << "too many";
    EXPECT_TRUE(meets_target(report_of(64, 32, StopReason::topology), after, 0.4))
        << "too many, with a reason";
    EXPECT_FALSE(meets_target(report_of(64, 32, StopReason::topology), after, 0.6))
        << "no reason excuses too few";
    EXPECT_FALSE(meets_target(report_of(64, 31, StopReason::target), after, 0.5)) << "miscounted";
}

TEST(Properties, notice_a_third_triangle_at_an_edge) {
    const Mesh before = sheet(2);
    Mesh after = before;
    add_triangle(after, 0, 4, 8);
    EXPECT_FALSE(has_no_new_non_manifold_edge(before, after));
}

TEST(Properties, notice_a_flipped_triangle) {
    const Mesh before = sheet(4);
    Mesh after = before;
    std::swap(after.triangles[30], after.triangles[31]);
    EXPECT_TRUE(has_no_flipped_triangle(before, before));
    EXPECT_FALSE(has_no_flipped_triangle(before, after));
}

// A sharp rim all around, where both sides nearly agree about what is nearest, and face opposite ways.
Mesh lens() {
    Mesh mesh = shapes::sphere();
    for (Vec3f& p : mesh.positions) p.y *= 0.02F;
    return mesh;
}

// Each of the triangles alone turned around, or all at once, which is the same to a check of single
// triangles.
Mesh turned_around(Mesh mesh) {
    for (size_t t = 0; t < mesh.triangle_count(); ++t)
        std::swap(mesh.triangles[3 * t], mesh.triangles[3 * t + 1]);
    return mesh;
}

TEST(Properties, notice_every_flipped_triangle_of_a_good_result) {
    const Algorithm& its = find_algorithm("its");
    const std::vector<Mesh> originals = {shapes::sphere(),
                                         shapes::box(),
                                         shapes::grid({.height = 0.1, .normals = true, .uvs = true}),
                                         shapes::torus(),
                                         shapes::blob({.segments = 40, .rings = 30}),
                                         lens()};
    for (const Mesh& before : originals) {
        const Mesh after = its.simplify(before, {}, {.triangles = before.triangle_count() / 2},
                                        ParameterValues::parse(its.parameters, {}), {})
                               .mesh;
        EXPECT_TRUE(has_no_flipped_triangle(before, after));
        const auto turned = has_no_flipped_triangle(before, turned_around(after));
        EXPECT_THAT(turned.message(), testing::StartsWith(fmt::format("{} of {} ", after.triangle_count(),
                                                                      after.triangle_count())));
    }
}

TEST(Properties, notice_a_vertex_that_is_pulled_over_an_edge) {
    const Mesh before = sheet(4);
    Mesh after = before;
    after.positions[12].x = 3.5F;  // the middle one, past its neighbour at x = 3
    EXPECT_FALSE(has_no_flipped_triangle(before, after));
}

TEST(Properties, notice_a_mirrored_texture) {
    const Mesh before = sheet(4, 2);
    EXPECT_TRUE(keeps_uv_orientation(before, before));
    Mesh wound = before;
    std::swap(wound.triangles[30], wound.triangles[31]);
    EXPECT_FALSE(keeps_uv_orientation(before, wound));
    Mesh pulled = before;  // in the texture alone: the wedge at (1, 1) lands right of its neighbour's
    const size_t wedge = 1 * 6 + 1;  // the seam's vertex has two in each row
    ASSERT_EQ(pulled.positions[pulled.wedge_vertex[wedge]], (Vec3f{1, 1, 0}));
    pulled.attributes[0].values[2 * wedge] = 2.5F;
    EXPECT_FALSE(keeps_uv_orientation(before, pulled));
    Mesh line = before;
    line.triangles[2] = line.triangles[1];
    EXPECT_FALSE(keeps_uv_orientation(before, line)) << "no area left";
}

TEST(Properties, notice_a_hole_and_an_eaten_border) {
    const Mesh before = sheet(4);
    Mesh hole = before;
    drop_triangle(hole, 10);
    EXPECT_FALSE(keeps_borders(before, hole, 0.05));
    Mesh eaten = before;
    drop_triangle(eaten, 0);
    drop_triangle(eaten, 0);
    EXPECT_FALSE(keeps_borders(before, eaten, 0.05));
}

TEST(Properties, notice_a_seam_that_was_welded_or_moved) {
    const Mesh before = sheet(4, 2);
    EXPECT_TRUE(keeps_seams(before, before, 0.05));
    EXPECT_FALSE(keeps_seams(before, sheet(4), 0.05));
    EXPECT_FALSE(keeps_seams(before, sheet(4, 3), 0.05));
}

TEST(Properties, notice_a_triangle_that_smears_the_texture_over_a_seam) {
    const Mesh before = sheet(4, 2);
    EXPECT_TRUE(keeps_charts(before, before));
    Mesh smeared = before;
    smeared.triangles[0] = smeared.triangles[3 * 7];  // a corner of the first row's right end
    EXPECT_FALSE(keeps_charts(before, smeared));
    Mesh shifted = before;
    shifted.attributes[0].values[0] += 0.5F;
    EXPECT_FALSE(keeps_charts(before, shifted));
}

}  // namespace
}  // namespace coppice::test
