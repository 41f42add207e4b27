#include "core/compare/distance_bounds.h"

#include <gtest/gtest.h>

#include <numbers>

#include "core/base/error.h"
#include "core/compare/surface_samples.h"
#include "tests/core/compare/meshes.h"
#include "tests/support/shapes.h"

namespace coppice {
namespace {

DistanceBounds bounds_of(const Mesh& from, const Mesh& to, double tolerance, unsigned threads = 2) {
    const Surface a = make_surface(from, {});
    Surface b = make_surface(to, {});
    const Bvh bvh(b, threads, {});
    return distance_bounds(a, bvh, tolerance, threads, {});
}

void expect_around(const DistanceBounds& bounds, double value, double tolerance) {
    EXPECT_LE(bounds.lower, value + 1e-7);  // positions are floats
    EXPECT_GE(bounds.upper, value - 1e-7);
    EXPECT_LE(bounds.upper - bounds.lower, tolerance * (1 + 1e-9));
}

TEST(DistanceBounds, hold_the_known_distance) {
    const double tolerance = 1e-3;
    expect_around(bounds_of(shapes::grid(), test::moved(shapes::grid(), test::shift(0, 0.25, 0)), tolerance),
                  0.25, tolerance);
    expect_around(bounds_of(test::octahedron(1), test::octahedron(2), tolerance), 1 / std::numbers::sqrt3,
                  tolerance);
    expect_around(bounds_of(test::octahedron(2), test::octahedron(1), tolerance), 1, tolerance);
    expect_around(bounds_of(shapes::box(), test::moved(shapes::box(), test::shift(0.1, 0, 0)), tolerance),
                  0.1, tolerance);
    expect_around(bounds_of(shapes::sphere(), shapes::sphere(), tolerance), 0, tolerance);
}

// Where one triangle lies over the gap between two others, no vertex and no edge is farthest.
TEST(DistanceBounds, hold_a_distance_that_is_largest_inside_a_triangle) {
    const Mesh lid = test::mesh_of({{-2, 1, -2}, {6, 1, -2}, {-2, 1, 6}}, {0, 1, 2});
    Mesh rim = test::mesh_of({{-2, 1, -2}, {6, 1, -2}, {2, 1, -2.0001F}}, {0, 1, 2});
    test::append(rim, test::mesh_of({{6, 1, -2}, {-2, 1, 6}, {2.0001F, 1, 2.0001F}}, {0, 1, 2}));
    test::append(rim, test::mesh_of({{-2, 1, 6}, {-2, 1, -2}, {-2.0001F, 1, 2}}, {0, 1, 2}));
    const double inradius = 8 / (2 + std::numbers::sqrt2);
    expect_around(bounds_of(lid, rim, 1e-3), inradius, 2e-3);
}

TEST(DistanceBounds, are_above_whatever_sampling_finds) {
    const Mesh fine = shapes::blob(), rough = shapes::blob({.segments = 23, .rings = 16});
    for (const bool swapped : {false, true}) {
        const Mesh &from = swapped ? rough : fine, &to = swapped ? fine : rough;
        const double tolerance = 1e-4;
        const DistanceBounds bounds = bounds_of(from, to, tolerance);
        EXPECT_LE(bounds.upper - bounds.lower, tolerance * (1 + 1e-9));
        const Surface a = make_surface(from, {});
        Surface b = make_surface(to, {});
        const Bvh bvh(b, 1, {});
        double found = 0;
        const AreaSamples samples(a, 200'000, 1, {});
        samples.visit(0, samples.count(), [&](const SurfaceSample& sample) {
            const auto [p, q, r] = a.corners(sample.triangle);
            found = std::max(found, bvh.nearest(interpolate(sample.weights, p, q, r)).distance());
        });
        EXPECT_LE(found, bounds.upper + 1e-12);
        EXPECT_GE(found, 0.95 * bounds.lower);
    }
}

TEST(DistanceBounds, are_the_same_to_the_bit_for_any_number_of_threads) {
    const DistanceBounds one = bounds_of(shapes::blob(), shapes::sphere(), 1e-3, 1);
    const DistanceBounds four = bounds_of(shapes::blob(), shapes::sphere(), 1e-3, 4);
    EXPECT_EQ(one.lower, four.lower);
    EXPECT_EQ(one.upper, four.upper);
}

TEST(DistanceBounds, come_to_an_end_at_the_last_digit) {
    const DistanceBounds bounds =
        bounds_of(test::octahedron(1), test::moved(test::octahedron(1), test::shift(0.01, 0, 0)), 1e-300);
    EXPECT_GE(bounds.upper, bounds.lower);
    EXPECT_NEAR(bounds.upper, bounds.lower, 1e-6);
}

TEST(DistanceBounds, stop_when_told) {
    std::stop_source stop;
    const Surface a = make_surface(shapes::sphere({.segments = 100, .rings = 50}), {});
    Surface b = make_surface(shapes::sphere({.segments = 90, .rings = 40}), {});
    const Bvh bvh(b, 2, {});
    Watch watch = {.stop = stop.get_token()};
    watch.progress = [&](double fraction) {
        if (fraction > 0.3) stop.request_stop();
    };
    EXPECT_THROW(distance_bounds(a, bvh, 1e-5, 2, watch), Error);
}

}  // namespace
}  // namespace coppice
