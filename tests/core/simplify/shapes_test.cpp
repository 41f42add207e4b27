#include "tests/support/shapes.h"

#include <gtest/gtest.h>

#include "core/mesh/adjacency.h"

namespace coppice {
namespace {

int64_t euler(const Mesh& m) {
    return static_cast<int64_t>(m.vertex_count()) - static_cast<int64_t>(edges(m).size()) +
           static_cast<int64_t>(m.triangle_count());
}

double volume(const Mesh& m) {
    double sum = 0;
    for (size_t t = 0; t < m.triangle_count(); ++t) {
        sum += dot(m.corner_position(t, 0), cross(m.corner_position(t, 1), m.corner_position(t, 2))) / 6;
    }
    return sum;
}

TEST(Shapes, closed_ones_are_closed_and_face_outwards) {
    for (const Mesh& m : {shapes::sphere(), shapes::sphere({.materials = 3}), shapes::box(),
                          shapes::faceted_sphere(), shapes::tetrahedron(), shapes::blob(), shapes::torus()}) {
        EXPECT_TRUE(is_consistent(m));
        EXPECT_EQ(topology(m).border_edges, 0U);
        EXPECT_EQ(topology(m).non_manifold_edges, 0U);
        EXPECT_EQ(topology(m).inconsistent_edges, 0U);
        EXPECT_GT(volume(m), 0);
    }
}

TEST(Shapes, have_the_topology_their_names_say) {
    EXPECT_EQ(euler(shapes::sphere()), 2);
    EXPECT_EQ(euler(shapes::torus()), 0);
    EXPECT_EQ(euler(shapes::grid()), 1);
    EXPECT_EQ(euler(shapes::cylinder()), 0);
    EXPECT_EQ(topology(shapes::cylinder({.segments = 10})).border_edges, 20U);
    EXPECT_EQ(topology(shapes::fin(8)).non_manifold_edges, 8U);
    EXPECT_GT(topology(shapes::soup()).non_manifold_edges, 0U);
}

TEST(Shapes, the_blob_is_as_large_as_the_bunny_of_the_paper) {
    EXPECT_EQ(shapes::blob().vertex_count(), 2503U);
    EXPECT_EQ(shapes::blob().triangle_count(), 5002U);
}

TEST(Shapes, a_seam_gives_its_vertices_two_wedges) {
    const Mesh m = shapes::cylinder({.segments = 10, .rows = 4, .seam = true});
    EXPECT_EQ(m.vertex_count(), 50U);
    EXPECT_EQ(m.wedge_count(), 55U);
    EXPECT_EQ(shapes::cylinder({.segments = 10, .rows = 4, .seam = false}).wedge_count(), 50U);
}

}  // namespace
}  // namespace coppice
