#include "core/compare/facing.h"

#include <gtest/gtest.h>

#include "tests/core/compare/meshes.h"
#include "tests/support/shapes.h"

namespace coppice {
namespace {

Flips flips(const Mesh& reference, const Mesh& candidate, unsigned threads = 2) {
    Surface from = make_surface(reference, {}), to = make_surface(candidate, {});
    const Bvh bvh(from, threads, {});
    return count_flips({from, bvh, from.bounds.diagonal()}, to, threads, {});
}

Mesh turned_over(Mesh mesh, size_t triangles) {
    for (size_t t = 0; t < triangles; ++t) std::swap(mesh.triangles[3 * t], mesh.triangles[3 * t + 1]);
    return mesh;
}

TEST(Flips, are_the_triangles_that_were_turned_over) {
    const Mesh sphere = shapes::sphere();
    EXPECT_EQ(flips(sphere, sphere).triangles, 0);
    EXPECT_EQ(flips(sphere, turned_over(sphere, 5)).triangles, 5);
    EXPECT_EQ(flips(sphere, turned_over(sphere, sphere.triangle_count())).triangles, sphere.triangle_count());
}

TEST(Flips, are_none_on_a_coarser_mesh) {
    EXPECT_EQ(flips(shapes::sphere({.segments = 48, .rings = 24}), shapes::sphere()).triangles, 0);
    EXPECT_EQ(flips(shapes::box({.cells = 8}), shapes::box({.cells = 1})).triangles, 0);
}

TEST(Flips, of_the_texture_are_the_triangles_that_it_is_mirrored_on) {
    const Mesh grid = shapes::grid({.uvs = true});
    Mesh mirrored = grid;
    for (size_t w = 0; w < mirrored.wedge_count(); ++w) mirrored.attributes[0].values[2 * w] *= -1;
    EXPECT_EQ(flips(grid, mirrored).texture_triangles, grid.triangle_count());
    EXPECT_EQ(flips(grid, mirrored).triangles, 0);
    EXPECT_EQ(flips(mirrored, mirrored).texture_triangles, 0);
    // Turned over with its texture, it shows the same from the other side.
    EXPECT_EQ(flips(grid, turned_over(grid, 7)).texture_triangles, 0);
}

TEST(Flips, leave_out_what_has_no_area) {
    EXPECT_EQ(flips(shapes::grid(), test::mesh_of({{0, 0, 0}, {1, 0, 0}, {2, 0, 0}}, {0, 1, 2})).triangles,
              0);
}

}  // namespace
}  // namespace coppice
