#include "core/scene/transform.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <span>
#include <vector>

namespace coppice {
namespace {

constexpr double half = 0.70710678118654752;  // sin and cos of 45 degrees

Transform linear(std::array<double, 9> l) {
    return {{l[0], l[1], l[2], 0, l[3], l[4], l[5], 0, l[6], l[7], l[8], 0}};
}

const Transform shear = linear({1, 0.5, 0, 0, 1, 0, 0, 0, 1});
const Transform mirror = linear({-1, 0, 0, 0, 1, 0, 0, 0, 1});
const Transform stretch = linear({2, 0, 0, 0, 3, 0, 0, 0, 0.5});

void expect_near(Vec3d actual, Vec3d expected, double tolerance = 1e-6) {
    EXPECT_NEAR(actual.x, expected.x, tolerance);
    EXPECT_NEAR(actual.y, expected.y, tolerance);
    EXPECT_NEAR(actual.z, expected.z, tolerance);
}

// One triangle in the xy plane with its true normal and a tangent.
Mesh triangle() {
    Mesh mesh;
    mesh.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0.5F}};
    mesh.wedge_vertex = {0, 1, 2};
    const Vec3f n = to_float(normalized(cross(Vec3d{1, 0, 0}, Vec3d{0, 1, 0.5})));
    mesh.attributes = {
        {.name = "NORMAL", .components = 3, .values = {n.x, n.y, n.z, n.x, n.y, n.z, n.x, n.y, n.z}},
        {.name = "TANGENT", .components = 4, .values = {1, 0, 0, 1, 1, 0, 0, 1, 1, 0, 0, 1}}};
    mesh.triangles = {0, 1, 2};
    mesh.triangle_slot = {0};
    mesh.slots.resize(1);
    return mesh;
}

Vec3d geometric_normal(const Mesh& mesh) {
    const Vec3d a = mesh.corner_position(0, 0);
    return normalized(cross(mesh.corner_position(0, 1) - a, mesh.corner_position(0, 2) - a));
}

Vec3d stored_normal(const Mesh& mesh) {
    const auto& v = mesh.find_attribute("NORMAL")->values;
    return {v[0], v[1], v[2]};
}

TEST(Transform, trs_scales_then_rotates_then_translates) {
    const Transform t = from_trs({10, 0, 0}, {0, 0, half, half}, {2, 1, 1});  // 90 degrees about z
    expect_near(t.point({1, 0, 0}), {10, 2, 0});
}

TEST(Transform, a_zero_quaternion_counts_as_the_identity) {
    expect_near(from_trs({}, {0, 0, 0, 0}, {1, 1, 1}).point({1, 2, 3}), {1, 2, 3});
}

TEST(Transform, a_product_applies_the_right_side_first) {
    const Transform move = from_trs({1, 0, 0}, {0, 0, 0, 1}, {1, 1, 1});
    expect_near((stretch * move).point({0, 0, 0}), {2, 0, 0});
    expect_near((move * stretch).point({0, 0, 0}), {1, 0, 0});
}

TEST(Transform, column_major_matrices_round_trip) {
    const Transform t = from_trs({1, 2, 3}, {0.5, 0.5, 0.5, 0.5}, {1, 2, 3});
    EXPECT_EQ(from_column_major(to_column_major(t)), t);
}

TEST(Transform, largest_scale_is_the_largest_singular_value) {
    EXPECT_NEAR(largest_scale(stretch), 3, 1e-12);
    // For x' = x + y/2 the singular values are (sqrt(17) +- 1) / 4.
    EXPECT_NEAR(largest_scale(shear), (std::sqrt(17.0) + 1) / 4, 1e-12);
}

// The fast path against the plain one.
TEST(Transform, largest_scale_of_many_is_found_where_squares_are_too_large_for_a_number) {
    const std::vector<Transform> many = {from_trs({}, {0, 0, 0, 1}, {1e200, 1e180, 1e180})};
    EXPECT_NEAR(largest_scale(many) / 1e200, 1, 1e-12);
}

TEST(Transform, largest_scale_of_many_is_the_largest_of_each) {
    EXPECT_EQ(largest_scale(std::span<const Transform>{}), 0);
    uint64_t state = 1;
    const auto random = [&] {
        state = state * 6364136223846793005ULL + 1442695040888963407ULL;
        return static_cast<double>(state >> 40) / (1 << 23) - 1;  // -1..1
    };
    std::vector<Transform> many;
    double largest = 0;
    for (int i = 0; i < 300; ++i) {
        Transform transform = from_trs({}, {random(), random(), random(), random()}, {1 + random(), 1, 1});
        if (i % 3 == 0) transform = transform * shear;
        if (i % 5 == 0) transform = transform * mirror;
        many.push_back(transform);
        largest = std::max(largest, largest_scale(transform));
        EXPECT_NEAR(largest_scale(many), largest, 1e-12);
    }
}

class TransformMesh : public testing::TestWithParam<Transform> {};

TEST_P(TransformMesh, keeps_normals_perpendicular_to_and_outside_of_their_triangle) {
    Mesh mesh = triangle();
    transform_mesh(GetParam(), mesh);
    expect_near(stored_normal(mesh), geometric_normal(mesh));
}

INSTANTIATE_TEST_SUITE_P(Affine, TransformMesh,
                         testing::Values(shear, mirror, stretch, mirror* shear* stretch,
                                         linear({0, -1, 0, 1, 0, 0, 0, 0, 1})));

TEST(TransformMesh, turns_the_tangents_handedness_when_it_mirrors) {
    Mesh mesh = triangle();
    transform_mesh(mirror, mesh);
    const auto& tangent = mesh.find_attribute("TANGENT")->values;
    EXPECT_EQ(tangent[0], -1);
    EXPECT_EQ(tangent[3], -1);
}

TEST(TransformMesh, moves_morph_deltas_without_the_translation) {
    Mesh mesh = triangle();
    mesh.morph_targets = {
        {.deltas = {{.name = "POSITION", .components = 3, .values = {1, 0, 0, 0, 0, 0, 0, 0, 0}}}}};
    transform_mesh(from_trs({5, 5, 5}, {0, 0, 0, 1}, {2, 2, 2}), mesh);
    EXPECT_EQ(mesh.morph_targets[0].deltas[0].values[0], 2);
    EXPECT_EQ(mesh.morph_targets[0].deltas[0].values[3], 0);
}

TEST(TransformBounds, holds_every_corner) {
    const Bounds box = transform_bounds(from_trs({}, {0, 0, half, half}, {1, 1, 1}), {{0, 0, 0}, {1, 2, 3}});
    expect_near(box.min, {-2, 0, 0});
    expect_near(box.max, {0, 1, 3});
}

}  // namespace
}  // namespace coppice
