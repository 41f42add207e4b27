// Surfaces whose distance is known, and attributes that were changed by a known amount.
#include "core/compare/compare_scenes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <numbers>
#include <random>

#include "core/mesh/weld.h"
#include "tests/core/compare/meshes.h"
#include "tests/support/shapes.h"

namespace coppice {
namespace {

using test::mesh_of, test::moved, test::octahedron, test::shift, test::with_added;

constexpr double sampled = 0.01;  // relative

SurfaceComparison compare(const Mesh& reference, const Mesh& candidate, const CompareOptions& options = {}) {
    return compare_meshes(reference, candidate, options, {});
}

void expect_all(const Spread& spread, double value, double tolerance = 1e-9) {
    EXPECT_NEAR(spread.largest, value, tolerance);
    EXPECT_NEAR(spread.mean, value, tolerance);
    EXPECT_NEAR(spread.root_mean_square, value, tolerance);
}

TEST(SurfaceDistance, of_a_mesh_from_itself_is_nothing) {
    for (const Mesh& mesh : {shapes::sphere(), shapes::soup(), shapes::box(), shapes::faceted_sphere(),
                             shapes::cylinder(), shapes::fin()}) {
        const SurfaceComparison same = compare(mesh, mesh);
        expect_all(same.symmetric, 0, 1e-7);
        EXPECT_NEAR(same.facets->largest, 0, 1e-4);
        EXPECT_NEAR(same.normals.value_or(AngleSpread{}).largest, 0, 1e-3);
        EXPECT_NEAR(same.texture.value_or(Spread{}).largest, 0, 1e-6);
        EXPECT_EQ(same.flips.triangles, 0);
        EXPECT_EQ(same.flips.texture_triangles, 0);
    }
}

TEST(SurfaceDistance, of_parallel_planes_is_their_distance_everywhere) {
    const SurfaceComparison found = compare(shapes::grid(), moved(shapes::grid(), shift(0, 0.25, 0)));
    expect_all(found.reference_to_candidate, 0.25);
    expect_all(found.candidate_to_reference, 0.25);
    expect_all(found.symmetric, 0.25);
}

// Inside a convex solid the nearest point is on the nearest of its planes; the planes of both are parallel.
TEST(SurfaceDistance, of_concentric_octahedra_is_that_of_their_planes_inwards_and_of_their_corners_outwards) {
    const SurfaceComparison found = compare(octahedron(1), octahedron(2));
    expect_all(found.reference_to_candidate, 1 / std::numbers::sqrt3);
    EXPECT_DOUBLE_EQ(found.candidate_to_reference.largest, 1);
    EXPECT_GT(found.candidate_to_reference.mean, 1 / std::numbers::sqrt3);
}

// The corner of the outer one projects onto that of the inner one, and no point of a facet is farther out.
TEST(SurfaceDistance, of_concentric_spheres_is_reached_at_the_corners) {
    const Mesh inner = shapes::sphere({.radius = 1}), outer = shapes::sphere({.radius = 3});
    const SurfaceComparison found = compare(inner, outer);
    EXPECT_NEAR(found.candidate_to_reference.largest, 2, 1e-6);
    EXPECT_LT(found.candidate_to_reference.mean, 2);
    EXPECT_LT(found.reference_to_candidate.largest, 2);
    // Every facet of a sphere of 24 by 12 is nearer to the centre than a corner by at most this.
    EXPECT_GT(found.reference_to_candidate.largest,
              2 * std::cos(std::numbers::pi / 12) * std::cos(std::numbers::pi / 24));
}

// Integrals over the six sides of the unit cube; see the comments.
TEST(SurfaceDistance, of_a_shifted_cube_is_what_integration_says) {
    constexpr double d = 0.1;
    const SurfaceComparison found =
        compare(shapes::box(), moved(shapes::box(), shift(d, 0, 0)), {.samples = 2000});
    const double behind = d;                                  // one side is outside, d away
    const double inside = d - 2 * d * d + 4 * d * d * d / 3;  // one within: min(d, distance to its rim)
    const double along = 4 * d * d / 2;                       // four strips stick out
    const double mean = (behind + inside + along) / 6;
    const double squares = (d * d + (d * d - 8 * d * d * d / 3 + 2 * d * d * d * d) + 4 * d * d * d / 3) / 6;
    for (const Spread& spread : {found.reference_to_candidate, found.candidate_to_reference}) {
        EXPECT_NEAR(spread.largest, d, 1e-7);
        EXPECT_NEAR(spread.mean, mean, sampled * mean);
        EXPECT_NEAR(spread.root_mean_square, std::sqrt(squares), sampled * std::sqrt(squares));
    }
}

TEST(SurfaceDistance, of_a_spike_is_its_height_from_the_spike_alone) {
    Mesh spiked = shapes::grid();
    size_t middle = 0;
    for (size_t v = 0; v < spiked.vertex_count(); ++v) {
        if (spiked.positions[v].x == 0.5F && spiked.positions[v].z == 0.5F) middle = v;
    }
    spiked.positions[middle].y = 0.5F;
    const SurfaceComparison found = compare(shapes::grid(), spiked);
    EXPECT_DOUBLE_EQ(found.candidate_to_reference.largest, 0.5);
    EXPECT_LT(found.reference_to_candidate.largest, 0.1);  // the plane has the foot of the spike beside it
    EXPECT_LT(found.candidate_to_reference.mean, 0.02);
    EXPECT_GT(found.reference_to_candidate.largest, 0.03);
}

TEST(SurfaceDistance, finds_a_needle_that_hardly_has_an_area) {
    Mesh needle = shapes::grid();
    test::append(needle, mesh_of({{0.5F, 0, 0.5F}, {0.5F + 1e-6F, 0, 0.5F}, {0.5F, 3, 0.5F}}, {0, 1, 2}));
    EXPECT_DOUBLE_EQ(compare(shapes::grid(), needle).candidate_to_reference.largest, 3);
}

TEST(SurfaceDistance, of_what_has_no_area_is_that_of_its_points) {
    const Mesh line = mesh_of({{0, 1, 0}, {0.5F, 1, 0.5F}, {1, 1, 1}}, {0, 1, 2});
    expect_all(compare(shapes::grid(), line).candidate_to_reference, 1);
}

void expect_equal(const Spread& a, const Spread& b) {
    EXPECT_EQ(a.largest, b.largest);
    EXPECT_EQ(a.mean, b.mean);
    EXPECT_EQ(a.root_mean_square, b.root_mean_square);
}

void expect_equal(const SurfaceComparison& a, const SurfaceComparison& b) {
    expect_equal(a.reference_to_candidate, b.reference_to_candidate);
    expect_equal(a.candidate_to_reference, b.candidate_to_reference);
    EXPECT_EQ(a.facets->mean, b.facets->mean);
    EXPECT_EQ(a.facets->percentile_95, b.facets->percentile_95);
    EXPECT_EQ(a.normals->mean, b.normals->mean);
    EXPECT_EQ(a.normals->largest, b.normals->largest);
    expect_equal(*a.texture, *b.texture);
    EXPECT_EQ(a.flips.triangles, b.flips.triangles);
}

Mesh rougher_blob() {
    return moved(shapes::blob({.segments = 31, .rings = 22}), shift(0.01, 0, 0.02));
}

TEST(SurfaceComparison, is_the_same_to_the_bit_for_any_number_of_threads) {
    const SurfaceComparison one = compare(shapes::blob(), rougher_blob(), {.threads = 1});
    for (const unsigned threads : {2U, 3U, 8U}) {
        expect_equal(compare(shapes::blob(), rougher_blob(), {.threads = threads}), one);
    }
}

TEST(SurfaceComparison, is_the_same_to_the_bit_whatever_the_order_of_triangles_and_corners) {
    Mesh shuffled = shapes::blob();
    std::vector<std::array<uint32_t, 3>> triangles;
    for (size_t t = 0; t < shuffled.triangle_count(); ++t) {
        const uint32_t* w = shuffled.triangles.data() + 3 * t;
        triangles.push_back({w[t % 3], w[(t + 1) % 3], w[(t + 2) % 3]});
    }
    std::shuffle(triangles.begin(), triangles.end(), std::mt19937(3));
    for (size_t t = 0; t < triangles.size(); ++t)
        std::copy(triangles[t].begin(), triangles[t].end(),
                  shuffled.triangles.begin() + 3 * static_cast<std::ptrdiff_t>(t));
    expect_equal(compare(shuffled, rougher_blob()), compare(shapes::blob(), rougher_blob()));
    expect_equal(compare(rougher_blob(), shuffled), compare(rougher_blob(), shapes::blob()));
}

TEST(SurfaceComparison, swaps_its_directions_with_its_arguments) {
    const SurfaceComparison a = compare(shapes::blob(), rougher_blob());
    const SurfaceComparison b = compare(rougher_blob(), shapes::blob());
    expect_equal(a.reference_to_candidate, b.candidate_to_reference);
    expect_equal(a.candidate_to_reference, b.reference_to_candidate);
    expect_equal(a.symmetric, b.symmetric);
    EXPECT_NEAR(a.normals->mean, b.normals->mean, 1e-12);
    EXPECT_EQ(a.normals->percentile_95, b.normals->percentile_95);
}

TEST(SurfaceComparison, is_the_same_in_any_place) {
    const Transform motion = from_trs({30, -20, 10}, {0.1, 0.7, -0.3, 0.6}, {1, 1, 1});
    const SurfaceComparison here = compare(shapes::blob(), rougher_blob(), {.samples = 50});
    const SurfaceComparison there =
        compare(moved(shapes::blob(), motion), moved(rougher_blob(), motion), {.samples = 50});
    EXPECT_NEAR(here.symmetric.mean, there.symmetric.mean, sampled * here.symmetric.mean);
    EXPECT_NEAR(here.symmetric.root_mean_square, there.symmetric.root_mean_square,
                sampled * here.symmetric.root_mean_square);
    EXPECT_NEAR(here.normals->mean, there.normals->mean, sampled * here.normals->mean);
    EXPECT_NEAR(here.texture->mean, there.texture->mean, 5 * sampled * here.texture->mean);
    EXPECT_NEAR(here.symmetric.largest, there.symmetric.largest, 5 * sampled * here.symmetric.largest);
}

TEST(SurfaceComparison, takes_other_samples_for_another_seed) {
    const SurfaceComparison a = compare(shapes::blob(), rougher_blob(), {.seed = 1});
    const SurfaceComparison b = compare(shapes::blob(), rougher_blob(), {.seed = 2});
    EXPECT_NE(a.symmetric.mean, b.symmetric.mean);
    EXPECT_NEAR(a.symmetric.mean, b.symmetric.mean, sampled * a.symmetric.mean);
}

TEST(NormalDeviation, is_the_angle_by_which_they_were_turned) {
    Mesh turned = shapes::grid({.normals = true});
    constexpr double angle = 10 * std::numbers::pi / 180;
    for (size_t w = 0; w < turned.wedge_count(); ++w) {
        turned.attributes[0].values[3 * w] = static_cast<float>(std::sin(angle));
        turned.attributes[0].values[3 * w + 1] = static_cast<float>(std::cos(angle));
    }
    const SurfaceComparison found = compare(shapes::grid({.normals = true}), turned);
    EXPECT_NEAR(found.normals->mean, 10, 1e-5);
    EXPECT_NEAR(found.normals->largest, 10, 1e-5);
    EXPECT_NEAR(found.normals->percentile_95, 10, 1e-5);
    EXPECT_NEAR(found.facets->largest, 0, 1e-6);
}

TEST(NormalDeviation, of_a_part_is_seen_by_mean_and_largest_and_not_by_the_percentile) {
    Mesh turned = shapes::faceted_sphere();
    for (size_t w = 0; w < 3; ++w) {  // of one triangle
        for (size_t i = 0; i < 3; ++i) turned.attributes[0].values[3 * turned.triangles[w] + i] *= -1;
    }
    const SurfaceComparison found = compare(shapes::faceted_sphere(), turned);
    EXPECT_NEAR(found.normals->largest, 180, 1e-3);
    EXPECT_LT(found.normals->percentile_95, 1);
    EXPECT_GT(found.normals->mean, 0.01);
}

TEST(NormalDeviation, is_not_there_where_only_one_has_normals) {
    const SurfaceComparison found = compare(shapes::grid({.normals = true}), shapes::grid());
    EXPECT_FALSE(found.normals.has_value());
    EXPECT_TRUE(found.facets.has_value());
}

TEST(TextureDeviation, is_the_shift_of_the_texture) {
    const Mesh grid = shapes::grid({.uvs = true});
    const SurfaceComparison found = compare(grid, with_added(grid, "TEXCOORD_0", 0.01F));
    expect_all(*found.texture, 0.01 * std::numbers::sqrt2, 1e-6);
    EXPECT_NEAR(found.texture_model_units->mean, 0.01 * std::numbers::sqrt2, 1e-6);  // the grid's scale is 1
    EXPECT_EQ(found.flips.texture_triangles, 0);
}

TEST(TextureDeviation, is_scaled_to_lengths_on_the_reference) {
    const Mesh large = moved(shapes::grid({.uvs = true}), test::scaling(8, 8, 8));
    const SurfaceComparison found = compare(large, with_added(large, "TEXCOORD_0", 0.01F));
    EXPECT_NEAR(found.texture->mean, 0.01 * std::numbers::sqrt2, 1e-6);
    EXPECT_NEAR(found.texture_model_units->largest, 0.08 * std::numbers::sqrt2, 1e-5);
}

// The nearest point of a sample beside the seam is often on its other side, where the texture begins anew.
TEST(TextureDeviation, is_that_on_the_same_side_of_a_seam) {
    const Mesh fine = shapes::cylinder({.segments = 64, .rows = 16});
    const double turn = 0.02;
    const Mesh turned = moved(fine, from_trs({}, {0, std::sin(turn / 2), 0, std::cos(turn / 2)}, {1, 1, 1}));
    const SurfaceComparison found = compare(fine, turned);
    EXPECT_NEAR(found.texture->mean, turn / (2 * std::numbers::pi), 2e-4);
    EXPECT_LT(found.texture->largest, 2 * turn / (2 * std::numbers::pi));
}

TEST(ColorDeviation, is_the_shift_of_the_colors) {
    const Mesh grid = shapes::grid({.colors = true});
    const SurfaceComparison found = compare(grid, with_added(grid, "COLOR_0", 0.1F));
    expect_all(*found.colors, 0.1 * std::numbers::sqrt3, 1e-6);
    EXPECT_FALSE(found.texture.has_value());
}

// Two sheets back to back, as leaves are made: the one that comes first is no better than the other.
TEST(NormalDeviation, at_coinciding_sheets_is_that_of_the_best_one) {
    Mesh leaf = shapes::grid({.normals = true});
    Mesh back = leaf;
    for (size_t t = 0; t < back.triangle_count(); ++t)
        std::swap(back.triangles[3 * t], back.triangles[3 * t + 1]);
    for (float& value : back.attributes[0].values) value *= -1;
    const size_t wedges = leaf.wedge_count();
    for (const uint32_t wedge : back.triangles)
        leaf.triangles.push_back(wedge + static_cast<uint32_t>(wedges));
    leaf.wedge_vertex.insert(leaf.wedge_vertex.end(), back.wedge_vertex.begin(), back.wedge_vertex.end());
    leaf.triangle_slot.resize(leaf.triangles.size() / 3);
    leaf.attributes[0].values.insert(leaf.attributes[0].values.end(), back.attributes[0].values.begin(),
                                     back.attributes[0].values.end());
    ASSERT_TRUE(is_consistent(leaf));
    const SurfaceComparison found = compare(leaf, leaf);
    EXPECT_EQ(found.normals->largest, 0);
    EXPECT_EQ(found.flips.triangles, 0);
}

}  // namespace
}  // namespace coppice
