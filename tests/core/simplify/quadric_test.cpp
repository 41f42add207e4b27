#include "core/simplify/garland_heckbert.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "core/simplify/plane_error.h"
#include "tests/core/simplify/run_algorithm.h"
#include "tests/support/shapes.h"
#include "tests/support/surface.h"

namespace coppice {
namespace {

Simplified simplify(const Mesh& mesh, uint64_t triangles, const test::Parameters& parameters = {}) {
    return test::run_algorithm(quadric(), mesh, {.triangles = triangles}, parameters);
}

double volume(const Mesh& mesh) {
    double sum = 0;
    for (size_t t = 0; t < mesh.triangle_count(); ++t)
        sum += dot(mesh.corner_position(t, 0), cross(mesh.corner_position(t, 1), mesh.corner_position(t, 2)));
    return sum / 6;
}

double mean_square_from_unit_sphere(const Mesh& mesh) {
    double sum = 0;
    for (const Vec3f p : mesh.positions) {
        const double away = length(to_double(p)) - 1;
        sum += away * away;
    }
    return sum / static_cast<double>(mesh.positions.size());
}

TEST(LeastPoint, is_where_three_planes_meet) {
    const Quadric q = plane_quadric({1, 0, 0}, {2, 0, 0}, 1) + plane_quadric({0, 1, 0}, {0, 3, 0}, 5) +
                      plane_quadric({0, 0, 1}, {0, 0, 4}, 0.1);
    const Vec3d p = least_point(q, {1.5, 3, 4}, {3, 3, 4}, Freedom::anywhere);
    EXPECT_NEAR(length(p - Vec3d{2, 3, 4}), 0, 1e-9);
}

TEST(LeastPoint, is_on_the_edge_where_planes_are_parallel) {
    const Quadric q = plane_quadric({0, 0, 1}, {0, 0, 0}, 1) + plane_quadric({0, 0, 1}, {0, 0, 1}, 3);
    const Vec3d p = least_point(q, {0, 0, 0}, {0, 0, 1}, Freedom::anywhere);
    EXPECT_NEAR(length(p - Vec3d{0, 0, 0.75}), 0, 1e-9);
}

TEST(LeastPoint, never_leaves_the_edge_nor_the_end_where_that_is_all_its_freedom) {
    const Quadric q = plane_quadric({1, 0, 0}, {9, 0, 0}, 1);
    EXPECT_EQ(least_point(q, {0, 0, 0}, {1, 0, 0}, Freedom::segment), (Vec3d{1, 0, 0}));
    EXPECT_EQ(least_point(q, {1, 0, 0}, {0, 0, 0}, Freedom::end_point), (Vec3d{0, 0, 0}));
}

TEST(QuadricAlgorithm, leaves_twelve_triangles_of_a_cube_and_all_of_its_volume) {
    const Simplified s = simplify(shapes::box({.cells = 6, .faceted = false}), 12);
    EXPECT_EQ(s.stop_reason, StopReason::target);
    EXPECT_EQ(s.mesh.triangle_count(), 12U);
    EXPECT_NEAR(std::abs(volume(s.mesh)), 1, 1e-5);
}

TEST(QuadricAlgorithm, is_nearer_to_a_sphere_with_points_of_its_own_than_with_end_points) {
    const Mesh sphere = shapes::sphere({.segments = 64, .rings = 32, .normals = false});
    const Mesh optimal = simplify(sphere, 400).mesh;
    const Mesh ends = simplify(sphere, 400, {{"placement", "endpoint"}}).mesh;
    // End points lie on the sphere, so the surface between them is inside of it; optimal ones balance that.
    EXPECT_LT(std::abs(std::abs(volume(optimal)) - std::abs(volume(sphere))),
              0.5 * std::abs(std::abs(volume(ends)) - std::abs(volume(sphere))));
    EXPECT_LT(mean_square_from_unit_sphere(optimal), 1e-3);
}

TEST(QuadricAlgorithm, keeps_a_linear_map_of_a_plane_as_it_is) {
    const Mesh grid = shapes::grid({.columns = 20, .rows = 20, .uvs = true});
    const Mesh result = simplify(grid, 60).mesh;
    const Attribute* uvs = result.find_attribute("TEXCOORD_0");
    ASSERT_NE(uvs, nullptr);
    // The map, from two wedges of the original: u = x-wise, v = z-wise, both linear.
    const Attribute* before = grid.find_attribute("TEXCOORD_0");
    const auto map = [&](const Mesh& mesh, const Attribute& a, size_t wedge) {
        const Vec3f p = mesh.positions[mesh.wedge_vertex[wedge]];
        return std::array<float, 4>{p.x, p.z, a.values[2 * wedge], a.values[2 * wedge + 1]};
    };
    const std::array<float, 4> origin = map(grid, *before, 0);
    for (size_t w = 0; w < result.wedge_count(); ++w) {
        const std::array<float, 4> at = map(result, *uvs, w);
        EXPECT_NEAR(std::abs(at[2] - origin[2]), std::abs(at[0] - origin[0]), 1e-5);
        EXPECT_NEAR(std::abs(at[3] - origin[3]), std::abs(at[1] - origin[1]), 1e-5);
    }
}

TEST(QuadricAlgorithm, keeps_the_sides_of_a_square) {
    const Simplified s = simplify(shapes::grid({.columns = 16, .rows = 16}), 2);
    const Bounds box = bounds(s.mesh.positions);
    EXPECT_NEAR(box.max.x - box.min.x, 1, 0.02);
    EXPECT_NEAR(box.max.z - box.min.z, 1, 0.02);
}

TEST(QuadricAlgorithm, stops_before_the_error_that_is_allowed) {
    const Mesh hills = shapes::grid({.columns = 40, .rows = 40, .height = 0.1});
    const Algorithm a = quadric();
    const Simplified s = a.simplify(hills, {}, {.triangles = 2, .error_model_units = 0.01},
                                    ParameterValues::parse(a.parameters, {}), {});
    EXPECT_EQ(s.stop_reason, StopReason::error_limit);
    EXPECT_LE(s.error_model_units, 0.01);
    EXPECT_LT(s.mesh.triangle_count(), hills.triangle_count() / 4);
    const test::Surface surface(s.mesh);
    for (const Vec3f p : hills.positions) EXPECT_LE(surface.distance_to(to_double(p)), 0.02);
}

}  // namespace
}  // namespace coppice
