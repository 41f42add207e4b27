#include "core/compare/bvh.h"

#include <gmock/gmock.h>

#include <random>
#include <set>

#include "core/base/error.h"
#include "tests/core/compare/meshes.h"
#include "tests/support/shapes.h"

namespace coppice {
namespace {

using test::mesh_of;

std::vector<Vec3d> points(size_t count, double reach) {
    std::mt19937 random(7);
    std::uniform_real_distribution<double> number(-reach, reach);
    std::vector<Vec3d> out(count);
    for (Vec3d& point : out) point = {number(random), number(random), number(random)};
    return out;
}

double brute_force_distance(const Surface& surface, Vec3d p) {
    double least = std::numeric_limits<double>::infinity();
    for (size_t t = 0; t < surface.triangle_count(); ++t) {
        const auto [a, b, c] = surface.corners(t);
        least = std::min(least, closest_point(p, a, b, c).squared_distance);
    }
    return std::sqrt(least);
}

void expect_like_brute_force(const Mesh& mesh, double reach) {
    Surface surface = make_surface(mesh, {});
    const Bvh bvh(surface, 1, {});
    uint32_t hint = Bvh::none;
    for (const Vec3d& p : points(300, reach)) {
        const double expected = brute_force_distance(surface, p);
        EXPECT_EQ(bvh.nearest(p).distance(), expected);
        const Bvh::Nearest hinted = bvh.nearest(p, hint);
        EXPECT_EQ(hinted.distance(), expected);
        hint = hinted.triangle;

        const double radius = expected * 1.1;
        std::set<uint32_t> within, expected_within;
        bvh.visit_within(p, radius * radius, [&](uint32_t t, const TrianglePoint&) { within.insert(t); });
        for (uint32_t t = 0; t < surface.triangle_count(); ++t) {
            const auto [a, b, c] = surface.corners(t);
            if (closest_point(p, a, b, c).squared_distance <= radius * radius) expected_within.insert(t);
        }
        EXPECT_EQ(within, expected_within);
    }
}

TEST(Bvh, finds_what_looking_at_every_triangle_finds) {
    expect_like_brute_force(shapes::soup(500), 2);
    expect_like_brute_force(shapes::sphere(), 2);
    expect_like_brute_force(shapes::grid({.height = 0.2}), 3);
    expect_like_brute_force(shapes::tetrahedron(), 3);
}

TEST(Bvh, is_as_exact_on_triangles_that_no_plane_parts) {
    std::vector<uint32_t> same;
    for (int i = 0; i < 1000; ++i) same.insert(same.end(), {0, 1, 2});
    expect_like_brute_force(mesh_of({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, same), 2);
}

// Each of them ten times as large and as far as the one before: bins part one at a time.
TEST(Bvh, is_as_exact_on_sizes_from_the_smallest_to_the_largest_float) {
    std::vector<Vec3f> positions;
    std::vector<uint32_t> triangles;
    for (int exponent = -37; exponent <= 37; ++exponent) {
        for (int copy = 0; copy < 20; ++copy) {
            const float size = std::pow(10.0F, static_cast<float>(exponent));
            for (const Vec3f& corner : {Vec3f{1, 0, 0}, Vec3f{2, 0, 1}, Vec3f{1, 1, 0}}) {
                triangles.push_back(static_cast<uint32_t>(positions.size()));
                positions.push_back(corner * size);
            }
        }
    }
    expect_like_brute_force(mesh_of(positions, triangles), 2);
    expect_like_brute_force(mesh_of(positions, triangles), 1e30);
}

TEST(Bvh, of_nothing_visits_nothing) {
    Surface surface = make_surface(mesh_of({}, {}), {});
    const Bvh bvh(surface, 1, {});
    bvh.visit_within({}, 1e300, [](uint32_t, const TrianglePoint&) { FAIL(); });
}

TEST(Bvh, is_the_same_for_any_number_of_threads) {
    const Mesh mesh = shapes::sphere({.segments = 200, .rings = 100});
    Surface one = make_surface(mesh, {}), four = make_surface(mesh, {});
    const Bvh alone(one, 1, {}), shared(four, 4, {});
    EXPECT_EQ(one.vertices, four.vertices);
    for (const Vec3d& p : points(300, 2)) EXPECT_EQ(alone.nearest(p).triangle, shared.nearest(p).triangle);
}

TEST(Bvh, meets_each_pair_of_boxes_once) {
    Surface surface = make_surface(shapes::soup(200), {});
    const Bvh bvh(surface, 1, {});
    const auto meets = [&](uint32_t t, uint32_t u) {
        Bounds a, b;
        for (const Vec3d& corner : surface.corners(t)) a.extend(corner);
        for (const Vec3d& corner : surface.corners(u)) b.extend(corner);
        return a.min.x <= b.max.x && b.min.x <= a.max.x && a.min.y <= b.max.y && b.min.y <= a.max.y &&
               a.min.z <= b.max.z && b.min.z <= a.max.z;
    };
    for (uint32_t t = 0; t < surface.triangle_count(); ++t) {
        std::vector<uint32_t> found, expected;
        bvh.visit_meeting(t, [&](uint32_t u) { found.push_back(u); });
        for (uint32_t u = t + 1; u < surface.triangle_count(); ++u) {
            if (meets(t, u)) expected.push_back(u);
        }
        EXPECT_THAT(found, testing::UnorderedElementsAreArray(expected));
    }
}

TEST(Bvh, stops_while_it_is_built) {
    std::stop_source stop;
    stop.request_stop();
    Surface surface = make_surface(shapes::sphere(), {});
    EXPECT_THROW(Bvh(surface, 2, {.stop = stop.get_token()}), Error);
}

}  // namespace
}  // namespace coppice
