// The tools that clustering algorithms share.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "core/mesh/adjacency.h"
#include "core/simplify/circumcentre.h"
#include "core/simplify/delaunay_flips.h"
#include "core/simplify/mean_edge.h"
#include "core/simplify/star_contraction.h"
#include "core/simplify/threshold_search.h"
#include "core/simplify/vertex_clusters.h"
#include "tests/support/shapes.h"

namespace coppice {
namespace {

TEST(Circumcentre, is_as_far_from_all_corners) {
    const Vec3d a = {0.1, 0.2, 0.3}, b = {1.3, 0.1, 0.4}, c = {0.6, 1.1, 0.9};
    const WeighedPoint centre = circumcentre(a, b, c, Circumcentre::clamp);
    EXPECT_NEAR(length(centre.point - a), length(centre.point - b), 1e-12);
    EXPECT_NEAR(length(centre.point - a), length(centre.point - c), 1e-12);
    EXPECT_NEAR(centre.weights[0] + centre.weights[1] + centre.weights[2], 1, 1e-12);
    const Vec3d blended = a * centre.weights[0] + b * centre.weights[1] + c * centre.weights[2];
    EXPECT_NEAR(length(blended - centre.point), 0, 1e-12);
}

TEST(Circumcentre, of_an_obtuse_triangle_is_outside_or_the_midpoint_of_its_longest_edge) {
    const Vec3d a = {0, 0, 0}, b = {2, 0, 0}, c = {1, 0.1, 0};
    EXPECT_NEAR(length(circumcentre(a, b, c, Circumcentre::clamp).point - Vec3d{1, 0, 0}), 0, 1e-12);
    const Vec3d printed = circumcentre(a, b, c, Circumcentre::paper).point;
    EXPECT_NEAR(printed.y, (0.1 * 0.1 - 1) / 0.2, 1e-9);  // the circle through (1, 0.1) and (+-1, 0) from 1
    EXPECT_NEAR(length(printed - a), length(printed - c), 1e-9);
}

TEST(Circumcentre, of_a_triangle_without_area_is_finite) {
    for (const Circumcentre mode : {Circumcentre::clamp, Circumcentre::paper}) {
        const WeighedPoint flat = circumcentre({0, 0, 0}, {1, 0, 0}, {3, 0, 0}, mode);
        EXPECT_EQ(flat.point, (Vec3d{1.5, 0, 0}));
        EXPECT_EQ(circumcentre({1, 1, 1}, {1, 1, 1}, {1, 1, 1}, mode).point,
                  (Vec3d{1.5, 1.5, 1.5} - Vec3d{0.5, 0.5, 0.5}));
    }
}

TEST(ThresholdSearch, finds_the_smallest_threshold_that_meets_the_target) {
    int runs = 0;
    const auto count = [&runs](double t) { return ++runs, 1000.0 / (1 + t); };
    const ThresholdFound found = search_threshold({.most = 100, .target = 250}, count);
    EXPECT_TRUE(found.reached);
    EXPECT_LE(found.count, 250);
    EXPECT_GE(found.count, 249);
    EXPECT_NEAR(found.threshold, 3, 0.05);
    EXPECT_LE(runs, 24);
}

TEST(ThresholdSearch, goes_just_beyond_a_jump) {
    const auto count = [](double t) { return t < 0.7 ? 1000.0 : 10.0; };
    const ThresholdFound found = search_threshold({.most = 1, .target = 500}, count);
    EXPECT_TRUE(found.reached);
    EXPECT_EQ(found.count, 10);
    EXPECT_NEAR(found.threshold, 0.7, 0.01);
}

TEST(ThresholdSearch, says_when_the_largest_threshold_is_not_enough) {
    const ThresholdFound found = search_threshold({.most = 2, .target = 5}, [](double t) { return 100 - t; });
    EXPECT_FALSE(found.reached);
    EXPECT_EQ(found.threshold, 2);
}

// A strip of quads, each cut along its longer diagonal.
Mesh badly_cut() {
    Mesh mesh = shapes::grid({.columns = 12, .rows = 4});
    for (Vec3f& p : mesh.positions) p.x += 1.5F * p.z;  // sheared: one diagonal is the longer one
    return mesh;
}

double smallest_angle(const Mesh& mesh) {
    double least = 4;
    for (size_t t = 0; t < mesh.triangle_count(); ++t) {
        for (size_t k = 0; k < 3; ++k) {
            const Vec3d p = mesh.corner_position(t, k);
            const Vec3d a = normalized(mesh.corner_position(t, (k + 1) % 3) - p);
            const Vec3d b = normalized(mesh.corner_position(t, (k + 2) % 3) - p);
            least = std::min(least, std::acos(std::clamp(dot(a, b), -1.0, 1.0)));
        }
    }
    return least;
}

TEST(DelaunayFlips, leave_no_edge_whose_opposite_angles_are_too_large) {
    const Mesh source = badly_cut();
    CollapseMesh mesh(source);
    const UvGuard uvs(mesh, source, {});
    EXPECT_GT(delaunay_flips(mesh, uvs, {}), 0U);
    EXPECT_EQ(delaunay_flips(mesh, uvs, {}), 0U);
    const Mesh flipped = mesh.extract(source);
    EXPECT_EQ(flipped.triangle_count(), source.triangle_count());
    EXPECT_EQ(flipped.vertex_count(), source.vertex_count());
    EXPECT_EQ(topology(flipped).non_manifold_edges, 0U);
    EXPECT_EQ(topology(flipped).inconsistent_edges, 0U);
    EXPECT_GT(smallest_angle(flipped), smallest_angle(source));
}

TEST(DelaunayFlips, leave_creases_and_seams) {
    const Mesh box = shapes::box({.cells = 1});
    CollapseMesh mesh(box);
    const UvGuard uvs(mesh, box, {});
    EXPECT_EQ(delaunay_flips(mesh, uvs, {}), 0U);
}

TEST(DelaunayFlips, leave_edges_that_may_not_flip) {
    const Mesh source = badly_cut();
    CollapseMesh mesh(source);
    const UvGuard uvs(mesh, source, {});
    const auto flips =
        delaunay_flips(mesh, uvs, {}, [](uint32_t a, uint32_t b) { return std::min(a, b) > 1; });
    EXPECT_GT(flips, 0U);
    for (uint32_t c = 0; c < 6; ++c) EXPECT_EQ(mesh.corner_vertex(c), source.corner_vertex(c / 3, c % 3));
}

class ContractionOfAGrid : public testing::Test {
  protected:
    // Vertex of a grid of 9 by 9.
    uint32_t at(uint32_t column, uint32_t row) const {
        const float x = static_cast<float>(column) / 8, z = static_cast<float>(row) / 8;
        const auto found = std::find_if(source_.positions.begin(), source_.positions.end(), [&](Vec3f p) {
            return std::abs(p.x - x) < 1e-6F && std::abs(p.z - z) < 1e-6F;
        });
        return static_cast<uint32_t>(found - source_.positions.begin());
    }
    Refusal contract(const std::vector<uint32_t>& set) {
        const std::vector<double> weights(set.size(), 1.0 / static_cast<double>(set.size()));
        Vec3d mean;
        for (const uint32_t v : set) mean = mean + work_.mesh().position(v) * weights.front();
        return work_.try_contract(set, {mean, weights});
    }

    Mesh source_ = shapes::grid({.columns = 8, .rows = 8, .uvs = true});
    Target target_ = {.triangles = 1};
    StarContraction work_{source_, target_, Watch{}};
};

TEST_F(ContractionOfAGrid, takes_two_triangles_per_vertex_and_blends_attributes) {
    EXPECT_EQ(contract({at(3, 3), at(4, 3), at(4, 4)}), Refusal::none);
    const Mesh mesh = work_.finish(StopReason::topology, {}).mesh;
    EXPECT_EQ(mesh.triangle_count(), source_.triangle_count() - 4);
    EXPECT_EQ(mesh.vertex_count(), source_.vertex_count() - 2);
    const Attribute& uvs = *mesh.find_attribute("TEXCOORD_0");
    const Attribute& original = *source_.find_attribute("TEXCOORD_0");
    // Of this grid texture coordinates are a linear map of x and z.
    const double scale_u =
        double{original.values[2 * size_t{at(8, 0)}]} - double{original.values[2 * size_t{at(0, 0)}]};
    for (size_t w = 0; w < mesh.wedge_count(); ++w) {
        const Vec3f p = mesh.positions[mesh.wedge_vertex[w]];
        EXPECT_NEAR(uvs.values[2 * w], original.values[2 * size_t{at(0, 0)}] + scale_u * double{p.x}, 1e-5);
    }
}

TEST_F(ContractionOfAGrid, keeps_borders_where_they_are) {
    EXPECT_EQ(contract({at(3, 0), at(4, 0)}), Refusal::none);  // along the border: its midpoint
    EXPECT_EQ(contract({at(0, 3), at(1, 3)}), Refusal::none);  // onto the border
    EXPECT_EQ(contract({at(0, 0), at(8, 0)}), Refusal::topology);
    const Mesh mesh = work_.finish(StopReason::topology, {}).mesh;
    for (const Edge& e : edges(mesh)) {
        if (!e.is_border()) continue;
        for (const uint32_t v : {e.a, e.b}) {
            const Vec3f p = mesh.positions[v];
            EXPECT_TRUE(p.x == 0 || p.x == 1 || p.z == 0 || p.z == 1);
        }
    }
    EXPECT_EQ(topology(mesh).non_manifold_edges, 0U);
}

TEST_F(ContractionOfAGrid, refuses_sets_that_are_apart_or_around_something) {
    EXPECT_EQ(contract({at(2, 2), at(5, 5)}), Refusal::topology);
    EXPECT_EQ(contract({at(2, 2), at(3, 2), at(4, 2), at(4, 3), at(4, 4), at(3, 4), at(2, 4), at(2, 3)}),
              Refusal::topology);
}

TEST(StarContraction, closes_no_tetrahedron_and_no_tube) {
    const Mesh solid = shapes::tetrahedron();
    const Target target = {.triangles = 1};
    StarContraction work(solid, target, Watch{});
    const std::array<uint32_t, 2> edge = {0, 1};
    const std::array<double, 2> weights = {0.5, 0.5};
    EXPECT_EQ(work.try_contract(edge, {(work.mesh().position(0) + work.mesh().position(1)) * 0.5, weights}),
              Refusal::topology);
}

TEST(VertexClusters, drop_what_collapses_and_keep_one_of_triangles_on_each_other) {
    const Mesh solid = shapes::tetrahedron();
    VertexClusters clusters(solid);
    const std::array<uint32_t, 2> edge = {0, 1};
    clusters.merge(edge, {0, 0, 0});
    EXPECT_EQ(clusters.count(solid).triangles, 2U);
    EXPECT_EQ(clusters.extract(solid, {}).triangle_count(), 1U);  // they are each other's back
}

TEST(MeanEdge, is_a_length) {
    const Mesh grid = shapes::grid({.columns = 10, .rows = 10});
    EXPECT_NEAR(mean_edge(grid), 0.1 * (2 + std::sqrt(2.0)) / 3, 1e-6);
}

}  // namespace
}  // namespace coppice
