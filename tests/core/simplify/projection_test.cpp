#include "core/simplify/projection.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/support/shapes.h"

namespace coppice {
namespace {

constexpr Vec3d a = {0, 0, 0}, b = {4, 0, 0}, c = {0, 4, 0};

void expect_weights(Vec3d point, std::array<double, 3> expected) {
    const std::array<double, 3> weights = nearest_in_triangle(point, a, b, c);
    for (size_t k = 0; k < 3; ++k) EXPECT_NEAR(weights[k], expected[k], 1e-12);
}

TEST(NearestInTriangle, is_below_a_point_above_the_inside) {
    expect_weights({1, 1, 7}, {0.5, 0.25, 0.25});
}

TEST(NearestInTriangle, is_on_the_edge_for_points_beyond_it) {
    expect_weights({1, -3, 2}, {0.75, 0.25, 0});
    expect_weights({3, 3, 0}, {0, 0.5, 0.5});
}

TEST(NearestInTriangle, is_a_corner_for_points_beyond_both_its_edges) {
    expect_weights({9, -1, 1}, {0, 1, 0});
}

TEST(NearestInTriangle, exists_on_triangles_without_area) {
    const std::array<double, 3> on_a_line = nearest_in_triangle({1, 5, 0}, a, b, {2, 0, 0});
    EXPECT_NEAR(on_a_line[0] + on_a_line[1] + on_a_line[2], 1, 1e-12);
    const Vec3d at = a * on_a_line[0] + b * on_a_line[1] + Vec3d{2, 0, 0} * on_a_line[2];
    EXPECT_NEAR(at.x, 1, 1e-12);
    const std::array<double, 3> on_a_point = nearest_in_triangle({1, 5, 0}, a, a, a);
    EXPECT_NEAR(on_a_point[0] + on_a_point[1] + on_a_point[2], 1, 1e-12);
}

// On a flat grid whose UVs are its coordinates, what a point gets is its own place.
TEST(Projection, interpolates_where_the_point_is) {
    const Mesh mesh = shapes::grid({.columns = 4, .rows = 4, .uvs = true});
    const CollapseMesh work(mesh);
    Projection projection(work);
    const uint32_t removed = 12, kept = 13;  // neighbours in the middle
    const std::vector<uint32_t> wedge_map = {work.wedge_begin(kept)};
    const Vec3d p = work.position(removed), q = work.position(kept);
    const Vec3d at = p * 0.3 + q * 0.7 + Vec3d{0, 0.2, 0.01};
    projection.project(removed, kept, wedge_map, at);

    Vec3d sum;
    double weights = 0;
    for (const WedgeShare& share : projection.shares(work.wedge_begin(kept))) {
        sum = sum + work.position(mesh.wedge_vertex[work.wedge_source(share.wedge)]) * share.weight;
        weights += share.weight;
    }
    EXPECT_NEAR(weights, 1, 1e-12);
    EXPECT_NEAR(sum.x, at.x, 1e-12);
    EXPECT_NEAR(sum.z, at.z, 1e-12);
}

}  // namespace
}  // namespace coppice
