// Pairs without an edge between them, and what quadric and gaps join by them.
#include "core/simplify/vertex_pairs.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>

#include "core/mesh/adjacency.h"
#include "core/simplify/gaps.h"
#include "core/simplify/garland_heckbert.h"
#include "tests/core/simplify/run_algorithm.h"
#include "tests/support/properties.h"
#include "tests/support/shapes.h"

namespace coppice {
namespace {

double area(const Mesh& mesh) {
    double sum = 0;
    for (size_t t = 0; t < mesh.triangle_count(); ++t) {
        sum += 0.5 * length(cross(mesh.corner_position(t, 1) - mesh.corner_position(t, 0),
                                  mesh.corner_position(t, 2) - mesh.corner_position(t, 0)));
    }
    return sum;
}

// Small triangles, each alone, in a cube of edge 1.
Mesh confetti(uint32_t triangles) {
    std::mt19937 random(5);
    const auto coordinate = [&random] { return static_cast<float>(random() % 100000) / 100000; };
    Mesh mesh;
    mesh.slots.push_back({});
    for (uint32_t t = 0; t < triangles; ++t) {
        const Vec3f at = {coordinate(), coordinate(), coordinate()};
        for (const Vec3f p : {at, Vec3f{at.x + 0.001F, at.y, at.z}, Vec3f{at.x, at.y + 0.001F, at.z}}) {
            mesh.triangles.push_back(static_cast<uint32_t>(mesh.positions.size()));
            mesh.wedge_vertex.push_back(mesh.triangles.back());
            mesh.positions.push_back(p);
        }
        mesh.triangle_slot.push_back(0);
    }
    return mesh;
}

class Pairs {
  public:
    Pairs(const Mesh& mesh, double distance)
        : mesh_(mesh), features_(find_features(mesh_, {})), pairs_(mesh_, features_.edges, {}) {
        pairs_.set_distance(distance, {});
    }

    VertexPairs& get() { return pairs_; }
    uint32_t vertex_count() const { return mesh_.vertex_count(); }
    std::vector<uint32_t> of(uint32_t vertex, std::vector<uint32_t> ring = {}) const {
        const auto known = static_cast<std::ptrdiff_t>(ring.size());
        pairs_.append(vertex, ring);
        return {ring.begin() + known, ring.end()};
    }
    double distance(uint32_t a, uint32_t b) const { return length(mesh_.position(a) - mesh_.position(b)); }

  private:
    CollapseMesh mesh_;
    Features features_;
    VertexPairs pairs_;
};

TEST(VertexPairs, are_those_that_a_search_of_all_finds) {
    for (const double distance : {0.02, 0.06, 0.3}) {  // with nothing, a few and hundreds around each
        const Mesh mesh = confetti(400);
        const Pairs pairs(mesh, distance);
        for (uint32_t v = 0; v < pairs.vertex_count(); ++v) {
            std::vector<uint32_t> expected;
            for (uint32_t w = 0; w < pairs.vertex_count(); ++w)
                if (w != v && pairs.distance(v, w) <= distance) expected.push_back(w);
            std::stable_sort(expected.begin(), expected.end(), [&](uint32_t a, uint32_t b) {
                return pairs.distance(v, a) < pairs.distance(v, b);
            });
            if (expected.size() > 8) expected.resize(8);
            const std::vector<uint32_t> found = pairs.of(v);
            ASSERT_EQ(found.empty(), expected.empty()) << distance;
            if (distance < 0.1) {
                ASSERT_EQ(found, expected) << distance;
            }
            // Where cells are crowded the nearest are still found.
            if (!expected.empty()) {
                ASSERT_EQ(found.front(), expected.front()) << distance;
            }
        }
    }
}

TEST(VertexPairs, have_no_edge_between_them_and_none_that_has_gone) {
    const Mesh mesh = shapes::tiles({.columns = 2, .rows = 1});
    Pairs pairs(mesh, 5);
    EXPECT_EQ(pairs.of(0).size(), 7U);
    EXPECT_EQ(pairs.of(0, {1, 2, 3}).size(), 4U);
    pairs.get().erase(5);
    const std::vector<uint32_t> left = pairs.of(0);
    EXPECT_EQ(left.size(), 6U);
    EXPECT_EQ(std::count(left.begin(), left.end(), 5U), 0);
    EXPECT_TRUE(pairs.of(5).empty());
}

TEST(VertexPairs, are_on_borders_alone) {
    EXPECT_TRUE(Pairs(shapes::sphere(), 1).get().empty());
    const Pairs sheet(shapes::grid({.columns = 4, .rows = 4}), 10);
    size_t paired = 0;
    for (uint32_t v = 0; v < sheet.vertex_count(); ++v) paired += sheet.of(v).empty() ? 0 : 1;
    EXPECT_EQ(paired, 16U);
}

TEST(VertexPairs, are_the_same_for_all_distances_beyond_the_mesh) {
    const Mesh mesh = confetti(20000);
    const Pairs all(mesh, 2);
    for (const double distance : {1e308, std::numeric_limits<double>::infinity()}) {
        const Pairs pairs(mesh, distance);
        for (uint32_t v = 0; v < pairs.vertex_count(); ++v) {
            ASSERT_FALSE(pairs.of(v).empty());
            ASSERT_EQ(pairs.of(v), all.of(v)) << distance;
        }
    }
}

TEST(VertexPairs, are_found_where_all_are_in_one_place) {
    Mesh mesh = confetti(2000);
    for (Vec3f& p : mesh.positions) p = {1, 2, 3};
    const Pairs pairs(mesh, 0.5);
    for (uint32_t v = 0; v < pairs.vertex_count(); ++v) ASSERT_EQ(pairs.of(v).size(), 8U);
}

constexpr size_t tiles_alone = 64;  // triangles of shapes::tiles() once nothing but edges is left to collapse

Simplified quadric_to(const Mesh& mesh, uint64_t triangles, const std::string& pair_distance) {
    return test::run_algorithm(quadric(), mesh, {.triangles = triangles}, {{"pair_distance", pair_distance}});
}

TEST(Joining, counts_where_vertices_are_wanted) {
    const Mesh mesh = shapes::tiles();  // of which edges leave three vertices each
    const Target target = {.vertices = 3 * tiles_alone - 40};
    const Simplified s = test::run_algorithm(gaps(), mesh, target);
    EXPECT_EQ(s.stop_reason, StopReason::target);
    EXPECT_LE(s.mesh.vertex_count(), *target.vertices);
}

TEST(Joining, goes_below_what_edges_leave_of_many_parts) {
    const Mesh mesh = shapes::tiles();  // of which edges leave a triangle each
    const Simplified edges_alone = quadric_to(mesh, 2, "0");
    EXPECT_EQ(edges_alone.mesh.triangle_count(), tiles_alone);
    EXPECT_NE(edges_alone.stop_reason, StopReason::target);

    const Simplified joined = quadric_to(mesh, 2, "0.2u");
    EXPECT_EQ(joined.stop_reason, StopReason::target);
    EXPECT_EQ(joined.mesh.triangle_count(), 2U);
    EXPECT_NEAR(area(joined.mesh), 7.9 * 7.9, 1e-3);
    EXPECT_TRUE(test::has_no_new_non_manifold_edge(mesh, joined.mesh));
}

TEST(Joining, leaves_apart_what_is_farther_than_the_distance) {
    const Mesh mesh = shapes::tiles();
    EXPECT_EQ(quadric_to(mesh, 2, "0.09u").mesh.triangle_count(), tiles_alone);
}

TEST(Joining, closes_a_crack_between_two_sheets) {
    const Mesh mesh = shapes::tiles({.columns = 2, .rows = 1, .cells = 8, .gap = 0.02});
    const Mesh result = quadric_to(mesh, 60, "0.03u").mesh;
    EXPECT_NEAR(area(result), 1.98 * 0.98, 0.01);
    for (const Edge& edge : edges(result)) {
        if (!edge.is_border()) continue;
        const Vec3f middle = (result.positions[edge.a] + result.positions[edge.b]) * 0.5F;
        const float off_the_rim = std::min({middle.x, 1.98F - middle.x, middle.z, 0.98F - middle.z});
        EXPECT_LT(off_the_rim, 0.01F) << "a border at x = " << middle.x << ", z = " << middle.z;
    }
}

TEST(Joining, draws_no_texture_over_a_gap) {
    const Mesh mesh = shapes::tiles({.columns = 2, .rows = 1, .cells = 4, .gap = 0.02, .uvs = true});
    const Simplified result = quadric_to(mesh, 2, "0.03u");
    EXPECT_EQ(result.mesh.triangle_count(), 4U);
    Mesh of_one_colour = mesh;  // a point in the texture
    std::fill(of_one_colour.attributes[0].values.begin(), of_one_colour.attributes[0].values.end(), 0.5F);
    EXPECT_EQ(quadric_to(of_one_colour, 2, "0.03u").mesh.triangle_count(), 2U);
}

TEST(Joining, keeps_materials_apart) {
    Mesh mesh = shapes::tiles({.columns = 2, .rows = 1, .cells = 4, .gap = 0.02});
    mesh.slots.push_back({});
    std::fill(mesh.triangle_slot.begin() + 32, mesh.triangle_slot.end(), 1U);
    EXPECT_EQ(quadric_to(mesh, 2, "0.03u").mesh.triangle_count(), 4U);
}

TEST(Joining, works_with_end_points_too) {
    const Mesh mesh = shapes::tiles();
    const Simplified result = test::run_algorithm(quadric(), mesh, {.triangles = 30},
                                                  {{"pair_distance", "0.2u"}, {"placement", "endpoint"}});
    EXPECT_EQ(result.stop_reason, StopReason::target);
}

Simplified gaps_to(const Mesh& mesh, uint64_t triangles, const test::Parameters& parameters = {}) {
    return test::run_algorithm(gaps(), mesh, {.triangles = triangles}, parameters);
}

TEST(Joining, of_gaps_needs_no_distance) {
    const Mesh mesh = shapes::tiles();
    EXPECT_EQ(gaps_to(mesh, 40).stop_reason, StopReason::target);
    EXPECT_EQ(gaps_to(mesh, 40, {{"pair_distance", 0.0}}).mesh.triangle_count(), tiles_alone);
}

TEST(Joining, of_gaps_goes_farther_once_nothing_else_is_left) {
    const Mesh mesh =
        shapes::tiles({.columns = 2, .rows = 2, .gap = 0.04});  // edges of squares as large are not collapsed
    EXPECT_EQ(gaps_to(mesh, 2, {{"pair_distance", 0.0}}).mesh.triangle_count(), 8U);
    EXPECT_EQ(gaps_to(mesh, 2, {{"pair_distance", 0.001}}).mesh.triangle_count(), 2U);
}

TEST(Joining, of_gaps_changes_no_more_area_than_is_tolerated) {
    // One sheet once its cracks are closed, which become surface.
    const Mesh mesh = shapes::tiles({.columns = 2, .rows = 1, .cells = 8, .gap = 0.02});
    EXPECT_NEAR(area(gaps_to(mesh, 60).mesh), 1.98 * 0.98, 1e-3);
    EXPECT_NEAR(area(gaps_to(mesh, 60, {{"area_tolerance", 0.0}}).mesh), area(mesh), 1e-3);
}

TEST(Joining, of_gaps_that_saves_no_triangle_is_not_kept) {
    const Mesh mesh = shapes::tiles({.gap = 0.3});  // too wide to be closed once edges have been collapsed
    const Mesh alone = gaps_to(mesh, 1, {{"pair_distance", 0.0}}).mesh;
    const Mesh result = gaps_to(mesh, 1).mesh;
    EXPECT_EQ(result.triangle_count(), tiles_alone);
    EXPECT_EQ(result.positions, alone.positions);
}

TEST(Joining, counts_a_gap_that_closes_as_error) {
    const Mesh mesh = shapes::tiles({.columns = 2, .rows = 1, .cells = 8, .gap = 0.02});
    EXPECT_GE(quadric_to(mesh, 60, "0.03u").error_model_units, 0.0099);
    const Simplified limited = gaps().simplify(mesh, {}, {.triangles = 2, .error_model_units = 0.009},
                                               ParameterValues::parse(gaps().parameters, {}), {});
    EXPECT_NEAR(area(limited.mesh), area(mesh), 1e-3);
}

TEST(Joining, of_gaps_leaves_large_plates_apart) {
    Mesh plates = shapes::grid({.columns = 8, .rows = 8});
    const Mesh lower = plates;
    const auto shift = static_cast<uint32_t>(lower.positions.size());
    for (const Vec3f p : lower.positions) plates.positions.push_back({p.x, p.y + 0.5F, p.z});
    for (const uint32_t vertex : lower.wedge_vertex) plates.wedge_vertex.push_back(vertex + shift);
    for (const uint32_t wedge : lower.triangles)
        plates.triangles.push_back(wedge + static_cast<uint32_t>(lower.wedge_count()));
    plates.triangle_slot.resize(2 * lower.triangle_count());
    const Mesh result = gaps_to(plates, 1).mesh;
    EXPECT_NEAR(area(result), 2, 0.02);
    EXPECT_EQ(result.triangle_count(), 4U);
}

}  // namespace
}  // namespace coppice
