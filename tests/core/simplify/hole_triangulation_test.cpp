#include "core/simplify/hole_triangulation.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/simplify/vertex_fan.h"
#include "tests/support/shapes.h"

namespace coppice {
namespace {

using Triangle = HoleTriangulation::Triangle;
using testing::ElementsAre;

bool any(uint32_t, uint32_t) {
    return true;
}

// In the plane z = 0, seen from above.
std::vector<Vec3d> regular(uint32_t corners) {
    std::vector<Vec3d> ring;
    for (uint32_t i = 0; i < corners; ++i) {
        const double angle = 2 * std::numbers::pi * i / corners;
        ring.push_back({std::cos(angle), std::sin(angle), 0});
    }
    return ring;
}

// Every second corner pulled in.
std::vector<Vec3d> star(uint32_t points) {
    std::vector<Vec3d> ring = regular(2 * points);
    for (size_t i = 1; i < ring.size(); i += 2) ring[i] = ring[i] * 0.4;
    return ring;
}

std::vector<double> areas(const std::vector<Vec3d>& ring, std::span<const Triangle> triangles) {
    std::vector<double> list;
    for (const auto& [a, b, c] : triangles) list.push_back(cross(ring[b] - ring[a], ring[c] - ring[a]).z / 2);
    return list;
}

double area_of(const std::vector<Vec3d>& ring) {
    double sum = 0;
    for (size_t i = 0; i < ring.size(); ++i) sum += cross(ring[i], ring[(i + 1) % ring.size()]).z / 2;
    return sum;
}

// All wound as the ring is, and as much area as it has: no overlap and no gap.
void expect_filled(const std::vector<Vec3d>& ring, const HoleTriangulation& hole) {
    EXPECT_EQ(hole.triangles().size(), ring.size() - 2);
    const std::vector<double> all = areas(ring, hole.triangles());
    EXPECT_GT(*std::min_element(all.begin(), all.end()), 0);
    double sum = 0;
    for (const double area : all) sum += area;
    EXPECT_NEAR(sum, area_of(ring), 1e-12);
}

TEST(HoleTriangulation, fills_rings_with_two_triangles_less_than_points) {
    HoleTriangulation hole;
    for (const uint32_t corners : {3U, 4U, 5U, 8U, 40U}) {
        for (const Stitch stitch : {Stitch::delaunay, Stitch::zigzag}) {
            const std::vector<Vec3d> ring = regular(corners);
            EXPECT_TRUE(hole.fill(ring, stitch, any));
            expect_filled(ring, hole);
        }
    }
}

TEST(HoleTriangulation, fills_what_is_not_convex) {
    HoleTriangulation hole;
    for (const uint32_t points : {3U, 5U, 12U}) {
        const std::vector<Vec3d> ring = star(points);
        EXPECT_TRUE(hole.fill(ring, Stitch::delaunay, any));
        expect_filled(ring, hole);
    }
}

TEST(HoleTriangulation, takes_the_better_shaped_triangles) {
    const std::vector<Vec3d> kite = {{-3, 0, 0}, {0, -1, 0}, {3, 0, 0}, {0, 1, 0}};
    HoleTriangulation hole;
    EXPECT_TRUE(hole.fill(kite, Stitch::delaunay, any));
    for (const Triangle& t : hole.triangles())
        EXPECT_TRUE(std::count(t.begin(), t.end(), 1U) == 1 && std::count(t.begin(), t.end(), 3U) == 1);
}

TEST(HoleTriangulation, gives_up_on_a_ring_that_crosses_itself) {
    const std::vector<Vec3d> crossed = {{0, 0, 0}, {2, 0, 0}, {2, 1, 0}, {0.2, -1, 0}, {0, 1, 0}};
    HoleTriangulation hole;
    EXPECT_FALSE(hole.fill(crossed, Stitch::delaunay, any));
}

TEST(HoleTriangulation, makes_no_forbidden_edge) {
    const std::vector<Vec3d> ring = regular(6);
    HoleTriangulation hole;
    const auto not_from_0 = [](uint32_t a, uint32_t b) { return a != 0 && b != 0; };
    EXPECT_TRUE(hole.fill(ring, Stitch::delaunay, not_from_0));
    expect_filled(ring, hole);
    EXPECT_EQ(std::count_if(hole.triangles().begin(), hole.triangles().end(),
                            [](const Triangle& t) { return std::count(t.begin(), t.end(), 0U) > 0; }),
              1);  // the ear at 0
    const auto none = [](uint32_t, uint32_t) { return false; };
    EXPECT_FALSE(hole.fill(ring, Stitch::delaunay, none));
    EXPECT_FALSE(hole.fill(ring, Stitch::zigzag, none));
}

// Figure 3 of the paper, left: v1 at the line, then from side to side.
TEST(HoleTriangulation, goes_from_side_to_side) {
    std::vector<Vec3d> ring = regular(7);
    HoleTriangulation hole;
    EXPECT_TRUE(hole.fill(ring, Stitch::zigzag, any));
    EXPECT_THAT(hole.triangles(), ElementsAre(Triangle{0, 1, 6}, Triangle{1, 2, 6}, Triangle{2, 5, 6},
                                              Triangle{2, 3, 5}, Triangle{3, 4, 5}));
}

TEST(HoleTriangulation, stitches_sorted_vertices_as_printed) {
    // By x: 0, 2, 4, 3, 1, 5, as v1, v3, v5, v4, v2, v6 of the paper.
    const std::vector<Vec3d> ring = {{9, 0, 0}, {5, 2, 0}, {8, 3, 0}, {6, 4, 0}, {7, 3, 0}, {4, 1, 0}};
    HoleTriangulation hole;
    EXPECT_TRUE(hole.fill(ring, Stitch::paper, any));
    std::vector<Triangle> sorted(hole.triangles().begin(), hole.triangles().end());
    for (Triangle& t : sorted) std::sort(t.begin(), t.end());
    EXPECT_THAT(sorted, ElementsAre(Triangle{0, 2, 4}, Triangle{0, 3, 4}, Triangle{0, 1, 3},
                                    Triangle{0, 1, 5}, Triangle{0, 2, 5}));
    const double whole = area_of(ring);
    for (const double area : areas(ring, hole.triangles())) EXPECT_GE(area * whole, 0);  // faces as the ring
}

TEST(VertexFan, orders_the_triangles_of_a_vertex) {
    const Mesh grid = shapes::grid({.columns = 4, .rows = 4});
    const CollapseMesh mesh(grid);
    VertexFan fan;
    uint32_t closed = 0, open = 0;
    for (uint32_t v = 0; v < mesh.vertex_count(); ++v) {
        ASSERT_TRUE(fan.gather(mesh, v));
        (fan.is_closed() ? closed : open) += 1;
        EXPECT_EQ(fan.ring().size(), fan.triangle_count() + (fan.is_closed() ? 0 : 1));
        for (uint32_t i = 0; i < fan.triangle_count(); ++i) {
            const uint32_t c = fan.corner(i);
            EXPECT_EQ(mesh.corner_vertex(c), v);
            EXPECT_EQ(mesh.corner_vertex(CollapseMesh::next_corner(c)), fan.ring()[i]);
            EXPECT_EQ(mesh.corner_vertex(CollapseMesh::previous_corner(c)),
                      fan.ring()[(i + 1) % fan.ring().size()]);
        }
    }
    EXPECT_EQ(closed, 9U);
    EXPECT_EQ(open, 16U);
}

TEST(VertexFan, is_none_where_three_triangles_meet_at_an_edge) {
    const Mesh fin = shapes::fin(4);
    const CollapseMesh mesh(fin);
    VertexFan fan;
    uint32_t none = 0;
    for (uint32_t v = 0; v < mesh.vertex_count(); ++v) none += fan.gather(mesh, v) ? 0 : 1;
    EXPECT_EQ(none, 5U);  // the foot of the wall
}

}  // namespace
}  // namespace coppice
