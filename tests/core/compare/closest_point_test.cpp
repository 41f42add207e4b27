#include "core/compare/closest_point.h"

#include <gtest/gtest.h>

#include <random>

#include "tests/support/surface.h"

namespace coppice {
namespace {

// That of the tests' own support is written independently: a plane and three segments.
TEST(ClosestPoint, is_as_far_as_another_implementation_finds) {
    std::mt19937 random(1);
    std::uniform_real_distribution<double> number(-1, 1);
    const auto point = [&] { return Vec3d{number(random), number(random), number(random)}; };
    for (int i = 0; i < 100'000; ++i) {
        const Vec3d p = point() * 2.0, a = point(), b = point(),
                    c = i % 3 == 0 ? a + (b - a) * number(random) : point();
        const TrianglePoint nearest = closest_point(p, a, b, c);
        EXPECT_NEAR(std::sqrt(nearest.squared_distance), test::distance(p, a, b, c), 1e-9) << i;
        const Vec3d there = interpolate(nearest.weights, a, b, c);
        EXPECT_NEAR(length(there - p), std::sqrt(nearest.squared_distance), 1e-12);
        for (const double weight : nearest.weights) EXPECT_GE(weight, 0);
    }
}

TEST(ClosestPoint, of_triangles_without_area_is_on_their_edges_or_corners) {
    const Vec3d a = {0, 0, 0}, b = {2, 0, 0}, middle = {1, 0, 0}, p = {1.5, 3, 4};
    EXPECT_DOUBLE_EQ(closest_point(p, a, a, a).squared_distance, 1.5 * 1.5 + 25);
    EXPECT_DOUBLE_EQ(closest_point(p, a, a, b).squared_distance, 25);
    EXPECT_DOUBLE_EQ(closest_point(p, a, b, middle).squared_distance, 25);
    EXPECT_DOUBLE_EQ(closest_point(p, middle, a, b).squared_distance, 25);
    EXPECT_DOUBLE_EQ(closest_point({3, 0, 0}, middle, a, b).squared_distance, 1);
}

}  // namespace
}  // namespace coppice
