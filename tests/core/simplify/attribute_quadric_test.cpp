#include "core/simplify/attribute_quadric/attribute_quadric.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <set>
#include <stop_token>
#include <vector>

#include "core/base/error.h"
#include "core/compare/compare_scenes.h"
#include "core/mesh/adjacency.h"
#include "core/scene/transform.h"
#include "core/simplify/garland_heckbert.h"
#include "core/simplify/its.h"
#include "core/simplify/line_guard.h"
#include "tests/core/simplify/run_algorithm.h"
#include "tests/support/properties.h"
#include "tests/support/shapes.h"

namespace coppice {
namespace {

using test::Parameters;

Simplified simplify(const Mesh& mesh, const Target& target, const Parameters& parameters = {}) {
    return test::run_algorithm(attribute_quadric(), mesh, target, parameters);
}

Target part_of(const Mesh& mesh, double ratio) {
    return {.triangles = static_cast<uint64_t>(ratio * static_cast<double>(mesh.triangle_count()))};
}

Mesh reduced(const Mesh& mesh, double ratio, const Parameters& parameters = {}) {
    const Simplified s = simplify(mesh, part_of(mesh, ratio), parameters);
    EXPECT_EQ(s.stop_reason, StopReason::target);
    return s.mesh;
}

SurfaceComparison compare(const Mesh& before, const Mesh& after) {
    return compare_meshes(before, after, {.samples = 3}, {});
}

double root_mean_square(const Mesh& before, const Mesh& after) {
    return compare(before, after).symmetric.root_mean_square;
}

double volume(const Mesh& mesh) {
    double sum = 0;
    for (size_t t = 0; t < mesh.triangle_count(); ++t)
        sum += dot(mesh.corner_position(t, 0), cross(mesh.corner_position(t, 1), mesh.corner_position(t, 2)));
    return sum / 6;
}

// Triangles whose texture is wound to the left, and to the right.
std::array<size_t, 2> windings_of_texture(const Mesh& mesh) {
    std::array<size_t, 2> count = {};
    const std::vector<float>& uv = mesh.find_attribute("TEXCOORD_0")->values;
    for (size_t t = 0; t < mesh.triangle_count(); ++t) {
        const auto coordinate = [&](size_t k, size_t i) {
            return double{uv[size_t{2} * mesh.triangles[3 * t + k] + i]};
        };
        const double area = (coordinate(1, 0) - coordinate(0, 0)) * (coordinate(2, 1) - coordinate(0, 1)) -
                            (coordinate(1, 1) - coordinate(0, 1)) * (coordinate(2, 0) - coordinate(0, 0));
        if (area != 0) ++count[area > 0 ? 0 : 1];
    }
    return count;
}

// Without texture coordinates, whose chart would hold on to both poles.
Mesh blob() {
    return shapes::blob({.uvs = false});
}

Mesh fine_torus() {
    return shapes::torus({.segments = 96, .sides = 48});
}

class AttributeQuadricAt : public testing::TestWithParam<double> {};

TEST_P(AttributeQuadricAt, is_twice_as_near_to_a_smooth_surface_as_its) {
    const Mesh before = blob();
    const Mesh of_its = test::run_algorithm(its(), before, part_of(before, GetParam())).mesh;
    EXPECT_LT(root_mean_square(before, reduced(before, GetParam())), 0.5 * root_mean_square(before, of_its));
}

TEST_P(AttributeQuadricAt, is_nearer_to_a_smooth_surface_than_quadrics_that_keep_no_volume) {
    const Mesh before = fine_torus();
    const Mesh of_quadric = test::run_algorithm(quadric(), before, part_of(before, GetParam())).mesh;
    EXPECT_LT(root_mean_square(before, reduced(before, GetParam())),
              0.9 * root_mean_square(before, of_quadric));
}

INSTANTIATE_TEST_SUITE_P(Ratios, AttributeQuadricAt, testing::Values(0.2, 0.05));

TEST(AttributeQuadric, keeps_the_volume_of_a_closed_surface) {
    const Mesh before = blob();
    const auto volume_lost = [&before](const Mesh& after) {
        return std::abs(volume(after) / volume(before) - 1);
    };
    EXPECT_LT(volume_lost(reduced(before, 0.1)), 0.001);
    EXPECT_GT(volume_lost(test::run_algorithm(its(), before, part_of(before, 0.1)).mesh), 0.003);
    EXPECT_GT(volume_lost(test::run_algorithm(quadric(), before, part_of(before, 0.1)).mesh), 0.003);
}

// Of a blob and a cylinder, whose charts end along a line. Holes there: zeux/meshoptimizer#518, #656.
TEST(AttributeQuadric, opens_no_seam_and_mirrors_no_texture) {
    for (const Mesh& mesh : {shapes::blob(), shapes::cylinder({.segments = 64, .rows = 48})}) {
        for (const double ratio : {0.5, 0.1}) {
            SCOPED_TRACE(testing::Message() << mesh.triangle_count() << " triangles at " << ratio);
            const Mesh after = reduced(mesh, ratio);
            if (topology(mesh).border_edges == 0) {
                EXPECT_EQ(topology(after).border_edges, 0U);
            }
            EXPECT_TRUE(test::keeps_borders(mesh, after, line_tolerance_of_diagonal));
            EXPECT_TRUE(test::keeps_seams(mesh, after, line_tolerance_of_diagonal));
            EXPECT_TRUE(test::keeps_uv_orientation(mesh, after));
            EXPECT_TRUE(test::has_no_flipped_triangle(mesh, after));
            const auto [left, right] = windings_of_texture(mesh);
            ASSERT_EQ(std::min(left, right), 0U);
            EXPECT_EQ(windings_of_texture(after)[left > 0 ? 1 : 0], 0U);
        }
    }
}

TEST(AttributeQuadric, keeps_the_texture_in_its_place) {
    for (const Mesh& mesh : {shapes::blob(), shapes::cylinder({.segments = 64, .rows = 48})}) {
        const auto texture = compare(mesh, reduced(mesh, 0.1)).texture;
        ASSERT_TRUE(texture);
        EXPECT_LT(texture->root_mean_square, 0.01);
    }
}

// Where a texture runs to a line and back again there is no seam to see: zeux/meshoptimizer#718.
TEST(AttributeQuadric, keeps_the_line_along_which_a_texture_is_mirrored) {
    Mesh grid = shapes::grid({.columns = 32, .rows = 32, .height = 0.05, .uvs = true});
    std::vector<float>& uv = grid.attributes[0].values;
    for (size_t w = 0; w < grid.wedge_count(); ++w) uv[2 * w] = std::abs(2 * uv[2 * w] - 1);
    for (const double ratio : {0.5, 0.1}) {
        const Mesh after = reduced(grid, ratio);
        const SurfaceComparison c = compare(grid, after);
        EXPECT_LT(c.texture->root_mean_square, 0.01);
        EXPECT_TRUE(test::keeps_uv_orientation(grid, after));
        const auto [left, right] = windings_of_texture(after);
        EXPECT_NEAR(static_cast<double>(left), static_cast<double>(right), 0.2 * static_cast<double>(left));
    }
}

TEST(AttributeQuadric, keeps_normals_near_those_of_the_surface) {
    const Mesh before = fine_torus();
    const auto own = compare(before, reduced(before, 0.1)).normals;
    const auto of_quadric =
        compare(before, test::run_algorithm(quadric(), before, part_of(before, 0.1)).mesh).normals;
    ASSERT_TRUE(own && of_quadric);
    EXPECT_LT(own->mean, 1);
    EXPECT_LT(own->percentile_95, 4);
    EXPECT_LT(own->mean, 0.7 * of_quadric->mean);
}

Mesh red_and_blue() {
    Mesh grid = shapes::grid({.columns = 32, .rows = 32, .colors = true});
    std::vector<float>& colors = grid.attributes[0].values;
    for (size_t w = 0; w < grid.wedge_count(); ++w) {
        const bool is_red = grid.positions[grid.wedge_vertex[w]].x < 0.5F;
        colors[3 * w] = is_red ? 1 : 0, colors[3 * w + 1] = 0, colors[3 * w + 2] = is_red ? 0 : 1;
    }
    return grid;
}

// zeux/meshoptimizer#652.
TEST(AttributeQuadric, keeps_the_edge_between_colours_where_they_have_a_weight) {
    const Mesh grid = red_and_blue();
    const auto with = compare(grid, reduced(grid, 0.1)).colors;
    const auto without = compare(grid, reduced(grid, 0.1, {{"color_weight", 0.0}})).colors;
    ASSERT_TRUE(with && without);
    EXPECT_LT(with->root_mean_square, 0.1 * without->root_mean_square);
    EXPECT_LT(with->root_mean_square, 0.02);
}

TEST(AttributeQuadric, moves_along_and_never_mirrors_what_has_no_weight) {
    const Parameters none = {{"normal_weight", 0.0}, {"uv_weight", 0.0}, {"color_weight", 0.0}};
    const Mesh flat = shapes::grid({.columns = 32, .rows = 32, .uvs = true, .colors = true});
    const SurfaceComparison c = compare(flat, reduced(flat, 0.1, none));
    EXPECT_LT(c.texture->largest, 1e-4);
    EXPECT_LT(c.colors->largest, 1e-4);
    const Mesh hills = shapes::grid({.columns = 40, .rows = 40, .height = 0.15, .uvs = true});
    const auto [left, right] = windings_of_texture(reduced(hills, 0.1, none));
    EXPECT_EQ(std::min(left, right), 0U);
}

std::set<std::array<float, 3>> border_positions(const Mesh& mesh) {
    std::set<std::array<float, 3>> all;
    for (const Edge& edge : edges(mesh)) {
        if (!edge.is_border()) continue;
        for (const uint32_t v : {edge.a, edge.b}) {
            const Vec3f p = mesh.positions[v];
            all.insert({p.x, p.y, p.z});
        }
    }
    return all;
}

// zeux/meshoptimizer#86.
TEST(AttributeQuadric, keeps_every_vertex_of_locked_borders) {
    for (const Mesh& mesh : {shapes::grid({.columns = 24, .rows = 24, .height = 0.1, .uvs = true}),
                             shapes::cylinder({.segments = 48, .rows = 32})}) {
        const auto before = border_positions(mesh);
        EXPECT_EQ(border_positions(reduced(mesh, 0.1, {{"lock_borders", true}})), before);
        EXPECT_LT(border_positions(simplify(mesh, part_of(mesh, 0.02)).mesh).size(), before.size());
    }
}

TEST(AttributeQuadric, keeps_locked_borders_though_the_target_is_missed_for_them) {
    const Mesh grid = shapes::grid({.columns = 24, .rows = 24, .height = 0.1, .uvs = true});
    const Simplified s = simplify(grid, {.triangles = 20}, {{"lock_borders", true}});
    EXPECT_EQ(border_positions(s.mesh), border_positions(grid));
    EXPECT_NE(s.stop_reason, StopReason::target);
    EXPECT_GT(s.mesh.triangle_count(), 20U);
}

TEST(AttributeQuadric, stays_within_an_error_and_takes_more_where_it_may_be_larger) {
    const Mesh mesh = blob();
    size_t before = mesh.triangle_count();
    for (const double error : {0.001, 0.003, 0.01, 0.03}) {
        const Simplified s = simplify(mesh, {.error_model_units = error});
        EXPECT_EQ(s.stop_reason, StopReason::error_limit);
        EXPECT_LE(s.error_model_units, error);
        EXPECT_GT(s.error_model_units, error / 2);
        EXPECT_LT(root_mean_square(mesh, s.mesh), error);
        EXPECT_LT(s.mesh.triangle_count(), before);
        before = s.mesh.triangle_count();
    }
}

TEST(AttributeQuadric, is_more_exact_at_its_best) {
    const Mesh mesh = blob();
    for (const double kept : {0.2, 0.05}) {
        const Target target = {.triangles =
                                   static_cast<uint64_t>(kept * static_cast<double>(mesh.triangle_count()))};
        const Simplified fast = simplify(mesh, target), best = simplify(mesh, target, {{"quality", "best"}});
        EXPECT_LT(root_mean_square(mesh, best.mesh), 0.97 * root_mean_square(mesh, fast.mesh)) << kept;
    }
}

TEST(AttributeQuadric, stops_at_the_vertices_wanted) {
    const Mesh mesh = blob();
    for (const uint64_t vertices : {2000U, 1000U, 100U}) {
        const Simplified s = simplify(mesh, {.vertices = vertices});
        EXPECT_EQ(s.stop_reason, StopReason::target);
        EXPECT_EQ(s.mesh.vertex_count(), vertices);
    }
}

TEST(AttributeQuadric, stops_at_whichever_target_keeps_more) {
    const Mesh mesh = blob();
    EXPECT_EQ(simplify(mesh, {.triangles = 1000, .vertices = 100}).mesh.triangle_count(), 1000U);
    EXPECT_EQ(simplify(mesh, {.triangles = 10, .vertices = 600}).mesh.vertex_count(), 600U);
    const Simplified s = simplify(mesh, {.triangles = 10, .error_model_units = 0.003});
    EXPECT_EQ(s.stop_reason, StopReason::error_limit);
    EXPECT_LE(s.error_model_units, 0.003);
}

Simplified simplify_instances(const Mesh& mesh, const std::vector<Transform>& instances, double ratio) {
    return attribute_quadric().simplify(mesh, instances, part_of(mesh, ratio),
                                        ParameterValues::parse(attribute_quadric().parameters, {}), {});
}

Transform scaled(double x, double y, double z) {
    return from_trs({5, 6, 7}, {0, 0, 0, 1}, {x, y, z});
}

TEST(AttributeQuadric, is_the_same_however_many_alike_and_of_what_size_there_are) {
    for (const Mesh& mesh : {shapes::blob(), shapes::grid({.height = 0.1, .uvs = true, .colors = true})}) {
        const Mesh alone = simplify_instances(mesh, {}, 0.2).mesh;
        for (const auto& instances :
             {std::vector<Transform>{Transform{}}, std::vector<Transform>(100, scaled(2, 2, 2)),
              std::vector<Transform>{scaled(0.1, 0.1, 0.1), scaled(7, 7, 7)}}) {
            const Mesh placed = simplify_instances(mesh, instances, 0.2).mesh;
            EXPECT_EQ(placed.triangles, alone.triangles);
            EXPECT_EQ(placed.positions, alone.positions);
        }
    }
}

TEST(AttributeQuadric, keeps_more_of_what_an_instance_stretches) {
    Mesh mesh = shapes::sphere({.segments = 64, .rings = 48, .normals = false});
    const std::vector<Transform> tall = {scaled(1, 20, 1)};
    const Mesh alone = simplify_instances(mesh, {}, 0.1).mesh,
               placed = simplify_instances(mesh, tall, 0.1).mesh;
    EXPECT_NE(placed.positions, alone.positions);
    const auto in_the_world = [&](Mesh m) {
        transform_mesh(tall[0], m);
        return m;
    };
    const double a = root_mean_square(in_the_world(mesh), in_the_world(alone));
    const double p = root_mean_square(in_the_world(mesh), in_the_world(placed));
    EXPECT_LT(p, a);
}

TEST(AttributeQuadric, writes_the_same_bytes_twice) {
    const Mesh mesh = shapes::blob();
    for (const char* quality : {"fast", "best"}) {
        const Mesh a = reduced(mesh, 0.1, {{"quality", quality}}),
                   b = reduced(mesh, 0.1, {{"quality", quality}});
        EXPECT_EQ(a.positions, b.positions);
        EXPECT_EQ(a.wedge_vertex, b.wedge_vertex);
        EXPECT_EQ(a.triangles, b.triangles);
        for (size_t i = 0; i < a.attributes.size(); ++i)
            EXPECT_EQ(a.attributes[i].values, b.attributes[i].values) << a.attributes[i].name;
    }
}

TEST(AttributeQuadric, stops_in_the_middle_of_a_pass) {
    const Mesh mesh = shapes::blob({.segments = 150, .rings = 100});
    std::stop_source stop;
    size_t passes = 0, looks = 0;
    const Watch watch = {.stop = stop.get_token(),
                         .progress = [&](double) { ++passes; },
                         .checked =
                             [&] {
                                 if (passes == 1 && ++looks == 5) stop.request_stop();
                             }};
    try {
        attribute_quadric().simplify(mesh, {}, part_of(mesh, 0.05),
                                     ParameterValues::parse(attribute_quadric().parameters, {}), watch);
        FAIL() << "went on";
    } catch (const Error& error) {
        EXPECT_EQ(error.code(), ErrorCode::job_cancelled);
    }
    EXPECT_EQ(looks, 5U);
    EXPECT_EQ(passes, 1U);
}

}  // namespace
}  // namespace coppice
