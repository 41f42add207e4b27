#include "core/compare/elements.h"

#include <gtest/gtest.h>

#include <numbers>

#include "tests/core/compare/meshes.h"
#include "tests/support/shapes.h"

namespace coppice {
namespace {

using test::mesh_of;

Elements count(const Mesh& mesh) {
    return count_elements(mesh, {});
}

TEST(Elements, of_a_cube) {
    const Elements cube = count(shapes::box({.cells = 4}));
    EXPECT_EQ(cube.triangles, 192);
    EXPECT_EQ(cube.vertices, 98);
    EXPECT_EQ(cube.components, 1);
    EXPECT_EQ(cube.euler_number, 2);
    EXPECT_EQ(cube.border_edges, 0);
    EXPECT_EQ(cube.non_manifold_edges, 0);
    EXPECT_EQ(cube.inconsistent_edges, 0);
    EXPECT_NEAR(cube.area, 6, 1e-6);
    EXPECT_NEAR(cube.volume, 1, 1e-6);
    EXPECT_NEAR(cube.smallest_angle, 45, 1e-5);
}

TEST(Elements, of_a_torus_and_of_two_spheres_tell_handles_and_components) {
    EXPECT_EQ(count(shapes::torus()).euler_number, 0);
    Mesh two = shapes::sphere({.normals = false});
    test::append(two, test::moved(shapes::sphere({.normals = false}), test::shift(5, 0, 0)));
    EXPECT_EQ(count(two).components, 2);
    EXPECT_EQ(count(two).euler_number, 4);
}

TEST(Elements, of_a_sphere_turned_inside_out_have_a_negative_volume) {
    Mesh sphere = shapes::sphere({.segments = 200, .rings = 100});
    EXPECT_NEAR(count(sphere).volume, 4.0 / 3 * std::numbers::pi, 0.01);
    for (size_t t = 0; t < sphere.triangle_count(); ++t)
        std::swap(sphere.triangles[3 * t], sphere.triangles[3 * t + 1]);
    EXPECT_NEAR(count(sphere).volume, -4.0 / 3 * std::numbers::pi, 0.01);
}

TEST(Elements, of_a_moebius_strip_have_one_border_and_run_against_each_other_somewhere) {
    constexpr uint32_t cells = 16;
    std::vector<Vec3f> positions;
    std::vector<uint32_t> triangles;
    for (uint32_t i = 0; i < cells; ++i) {
        const double turn = 2 * std::numbers::pi * i / cells;
        for (const double side : {-0.3, 0.3}) {
            const double out = 1 + side * std::cos(turn / 2);
            positions.push_back(
                to_float({out * std::cos(turn), side * std::sin(turn / 2), out * std::sin(turn)}));
        }
        const uint32_t a = 2 * i, b = 2 * i + 1;
        const bool is_last = i + 1 == cells;  // half a turn: the sides have changed places
        const uint32_t c = is_last ? 1 : a + 2, d = is_last ? 0 : b + 2;
        triangles.insert(triangles.end(), {a, b, c, b, d, c});
    }
    const Elements strip = count(mesh_of(positions, triangles));
    EXPECT_EQ(strip.euler_number, 0);
    EXPECT_EQ(strip.border_edges, 2 * cells);
    EXPECT_EQ(strip.components, 1);
    EXPECT_EQ(strip.non_manifold_edges, 0);
    EXPECT_EQ(strip.inconsistent_edges, 1);
}

TEST(Elements, of_a_book_have_one_edge_with_three_pages) {
    const Elements book =
        count(mesh_of({{0, 0, 0}, {0, 2, 0}, {1, 0, 0}, {-1, 0, 0}, {0, 0, 1}}, {0, 1, 2, 0, 1, 3, 0, 1, 4}));
    EXPECT_EQ(book.non_manifold_edges, 1);
    EXPECT_EQ(book.border_edges, 6);
    EXPECT_NEAR(book.border_length, 3 * (1 + std::sqrt(5.0)), 1e-12);
}

TEST(Elements, tell_degenerate_and_duplicate_triangles) {
    const Elements found = count(
        mesh_of({{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {0, 1, 0}}, {0, 1, 3, 1, 3, 0, 1, 0, 3, 0, 1, 2, 0, 0, 3}));
    EXPECT_EQ(found.duplicate_triangles, 1);   // the rotated one; the one that faces the other way is none
    EXPECT_EQ(found.degenerate_triangles, 2);  // on a line, and with a corner twice
}

TEST(Elements, of_nothing_are_none) {
    EXPECT_EQ(count(mesh_of({}, {})).triangles, 0);
    EXPECT_EQ(count(mesh_of({}, {})).components, 0);
}

}  // namespace
}  // namespace coppice
