#include "core/simplify/gaea.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>
#include <set>

#include "core/simplify/codebook.h"
#include "core/simplify/codebook_family.h"
#include "core/simplify/normal_patches.h"
#include "tests/core/simplify/run_algorithm.h"
#include "tests/support/properties.h"
#include "tests/support/shapes.h"

namespace coppice {
namespace {

using test::Parameters;

Simplified simplify(const Mesh& mesh, const Target& target, const Parameters& parameters = {}) {
    return test::run_algorithm(gaea(), mesh, target, parameters);
}

size_t left(const Mesh& mesh, const Parameters& parameters) {
    return simplify(mesh, {}, parameters).mesh.triangle_count();
}

CodebookFamily family(const Parameters& parameters, const Bounds& box = {}) {
    return {ParameterValues::parse(gaea().parameters, parameters), box};
}

const Mesh& ball() {
    static const Mesh mesh = shapes::blob({.segments = 60, .rings = 40, .uvs = false});
    return mesh;
}

// Two flat discs, joined at the rim, that both face up: closed, and all has one normal.
Mesh pillow() {
    constexpr uint32_t around = 8;
    Mesh mesh;
    mesh.slots.resize(1);
    const auto add_ring = [&mesh](float radius) {
        const auto first = static_cast<uint32_t>(mesh.positions.size());
        for (uint32_t i = 0; i < around; ++i) {
            const float angle = 2 * std::numbers::pi_v<float> * static_cast<float>(i) / around;
            mesh.positions.push_back({radius * std::sin(angle), 0, radius * std::cos(angle)});
        }
        return first;
    };
    const uint32_t rim = add_ring(2);
    for (int disc = 0; disc < 2; ++disc) {
        const uint32_t ring = add_ring(1), hub = ring + around;
        mesh.positions.push_back({0, 0, 0});
        for (uint32_t i = 0; i < around; ++i) {
            const uint32_t next = (i + 1) % around;
            for (const uint32_t v : {rim + i, rim + next, ring + i, ring + i, rim + next, ring + next, hub,
                                     ring + i, ring + next})
                mesh.triangles.push_back(v);
        }
    }
    mesh.triangle_slot.resize(mesh.triangles.size() / 3);
    for (uint32_t v = 0; v < mesh.positions.size(); ++v) mesh.wedge_vertex.push_back(v);
    return mesh;
}

// Degrees to the nearest other code-vector: the least and the most of all.
std::pair<double, double> spacing(const Codebook& codebook) {
    double least = 180, most = 0;
    for (const Vec3d& v : codebook.vectors()) {
        double nearest = 180;
        for (const Vec3d& w : codebook.vectors()) {
            if (&v != &w) nearest = std::min(nearest, std::acos(dot(v, w)) * 180 / std::numbers::pi);
        }
        least = std::min(least, nearest), most = std::max(most, nearest);
    }
    return {least, most};
}

constexpr CodebookSizes codebooks[] = {{1, 1, 1}, {2, 2, 2},  {3, 3, 3},  {5, 4, 3},
                                       {5, 5, 5}, {20, 1, 1}, {1, 7, 30}, {32, 32, 32}};

TEST(Codebook, has_as_many_vectors_as_the_paper_says) {
    for (uint64_t n = 1; n < 8; ++n) {
        const auto m = static_cast<uint32_t>(n);
        EXPECT_EQ(Codebook({m, m, m}, Warp::flat, 0).vectors().size(), 6 * n * n);
    }
    EXPECT_EQ(code_vector_count({5, 4, 3}), 94U);
    for (const CodebookSizes& sizes : codebooks)
        EXPECT_EQ(Codebook(sizes, Warp::tan, 0).vectors().size(), code_vector_count(sizes));
}

TEST(Codebook, has_distinct_unit_vectors_all_around) {
    for (const CodebookSizes& sizes : codebooks) {
        const Codebook codebook(sizes, Warp::flat, 0);
        Vec3d sum;
        std::set<std::array<double, 3>> distinct;
        for (const Vec3d& v : codebook.vectors()) {
            EXPECT_NEAR(length(v), 1, 1e-12);
            sum = sum + v;
            distinct.insert({v.x, v.y, v.z});
        }
        EXPECT_LT(length(sum), 1e-9);
        EXPECT_EQ(distinct.size(), codebook.vectors().size());
    }
    const Codebook cube({1, 1, 1}, Warp::flat, 0);
    EXPECT_NEAR(length(cube.vectors()[cube.nearest({0.1, -3, 0.2})] - Vec3d{0, -1, 0}), 0, 1e-12);
}

TEST(Codebook, is_more_even_with_angles_than_with_steps) {
    const auto [flat_least, flat_most] = spacing(Codebook({5, 5, 5}, Warp::flat, 0));
    EXPECT_NEAR(flat_least, 12.5, 0.1);
    EXPECT_NEAR(flat_most, 20.4, 0.1);
    const auto [tan_least, tan_most] = spacing(Codebook({5, 5, 5}, Warp::tan, 0));
    EXPECT_NEAR(tan_least, 14.7, 0.1);
    EXPECT_NEAR(tan_most, 17.6, 0.1);
}

TEST(Codebook, finds_the_nearest_as_looking_at_all_does) {
    std::mt19937 random(3);
    std::normal_distribution<double> normal;
    std::vector<Vec3d> directions = {{1, 0, 0}, {0, -1, 0}, {1, 1, 0}, {1, 1, 1}, {-1, 1, -1}, {0, -1, 1}};
    for (int i = 0; i < 3000; ++i) directions.push_back({normal(random), normal(random), normal(random)});
    for (const CodebookSizes& sizes : codebooks) {
        for (const Warp warp : {Warp::flat, Warp::tan}) {
            for (const uint64_t lookups : {0U, 5000U, 1000000U}) {
                const Codebook codebook(sizes, warp, lookups);
                for (const Vec3d& d : directions) {
                    const auto less = [&d](const Vec3d& v, const Vec3d& w) { return dot(d, v) < dot(d, w); };
                    const auto all = codebook.vectors();
                    const auto best = std::max_element(all.begin(), all.end(), less) - all.begin();
                    ASSERT_EQ(codebook.nearest(d), best) << sizes[0] << ' ' << sizes[1] << ' ' << sizes[2];
                }
            }
        }
    }
}

TEST(CodebookFamily, is_in_proportion_to_the_box) {
    const CodebookFamily f = family({{"schema", "xyz"}, {"codebook_size", 150.0}}, {{0, 0, 0}, {8, 4, 2}});
    const CodebookSizes start = f.sizes(f.start());
    EXPECT_TRUE(f.is_given());
    EXPECT_LE(code_vector_count(start), 150U);
    EXPECT_GT(code_vector_count(f.sizes(f.start() + 0.5)), 150U);
    EXPECT_EQ(f.sizes(8), (CodebookSizes{8, 4, 2}));
    EXPECT_EQ(f.sizes(1), (CodebookSizes{1, 1, 1}));
    const CodebookFamily again =
        family({{"schema", "xyz"}, {"codebook_size", f.threshold(f.sizes(8))}}, {{0, 0, 0}, {8, 4, 2}});
    EXPECT_EQ(again.sizes(again.start()), f.sizes(8)) << "what is reported gives the same codebook";
}

TEST(CodebookFamily, starts_where_calculating_with_the_start_gives_the_same) {
    for (int n = 2; n <= 64; ++n) {
        const CodebookFamily f =
            family({{"schema", "xyz"}, {"codebook_size", 6.0 * n * n}}, {{0, 0, 0}, {1, 1, 1}});
        EXPECT_EQ(f.sizes(1 / (1 / f.start())), f.sizes(f.start())) << n;
        EXPECT_EQ(f.threshold(f.sizes(f.start())), 6 * n * n);
    }
}

TEST(CodebookFamily, has_no_more_cells_along_an_axis_for_a_needle) {
    const CodebookFamily f =
        family({{"schema", "xyz"}, {"codebook_size", 24576.0}}, {{0, 0, 0}, {1000, 1, 1}});
    EXPECT_EQ(f.sizes(f.start()), (CodebookSizes{64, 1, 1}));
}

TEST(CodebookFamily, takes_what_is_given) {
    const CodebookFamily xyz = family({{"schema", "xyz"}, {"xyz", "5-4-30"}});
    EXPECT_EQ(xyz.sizes(xyz.start()), (CodebookSizes{5, 4, 30}));
    EXPECT_EQ(xyz.threshold({5, 4, 3}), 94);
    EXPECT_EQ(family({{"n", 7.0}}).sizes(7), (CodebookSizes{7, 7, 7}));
    EXPECT_FALSE(family({}).is_given());
    EXPECT_EQ(family({}).start(), 5);
    EXPECT_EQ(family({{"schema", "xyz"}}).sizes(family({{"schema", "xyz"}}).start()),
              (CodebookSizes{5, 5, 5}))
        << "of no box";
}

TEST(NormalPatches, are_the_sides_of_a_box) {
    const Mesh box = shapes::box({.cells = 4, .faceted = false});
    const CollapseMesh mesh(box);
    NormalPatches patches(mesh, {});
    for (const uint32_t n : {1U, 2U, 5U}) {
        patches.group(Codebook({n, n, n}, Warp::flat, 192), 2, {});
        EXPECT_EQ(patches.patch_count(), 6U);
        uint32_t inside = 0;
        for (uint32_t v = 0; v < mesh.vertex_count(); ++v) inside += patches.patch_around(v) != no_index;
        EXPECT_EQ(inside, 6 * 9U);
    }
}

TEST(NormalPatches, of_one_code_vector_are_apart_where_no_edge_connects_them) {
    Mesh two = shapes::grid({.columns = 2, .rows = 2});
    const Mesh one = two;
    for (const Vec3f p : one.positions) two.positions.push_back({p.x + 5, p.y, p.z});
    for (uint32_t v = 0; v < one.vertex_count(); ++v)
        two.wedge_vertex.push_back(v + static_cast<uint32_t>(one.vertex_count()));
    for (const uint32_t w : one.triangles)
        two.triangles.push_back(w + static_cast<uint32_t>(one.wedge_count()));
    two.triangle_slot.resize(two.triangles.size() / 3);
    const CollapseMesh mesh(two);
    NormalPatches patches(mesh, {});
    patches.group(Codebook({1, 1, 1}, Warp::flat, 16), 0, {});
    EXPECT_EQ(patches.patch_count(), 2U);
    EXPECT_NE(patches.patch(0), patches.patch(8));
}

TEST(NormalPatches, take_in_triangles_without_area) {
    Mesh sheet = shapes::grid({.columns = 6, .rows = 6});
    // One column onto another: a strip of triangles without area across the sheet.
    for (Vec3f& p : sheet.positions)
        if (std::abs(p.x - 0.5F) < 0.01F) p.x = 1.0F / 3;
    const CollapseMesh mesh(sheet);
    NormalPatches patches(mesh, {});
    patches.group(Codebook({3, 3, 3}, Warp::flat, 72), 2, {});
    EXPECT_EQ(patches.patch_count(), 1U);
    for (Vec3f& p : sheet.positions) p.x = 0;
    const CollapseMesh flat(sheet);
    NormalPatches nothing(flat, {});
    nothing.group(Codebook({3, 3, 3}, Warp::flat, 72), 2, {});
    EXPECT_EQ(nothing.patch_count(), 1U);
}

TEST(NormalPatches, move_to_where_their_triangles_face) {
    const CollapseMesh mesh(ball());
    NormalPatches patches(mesh, {});
    const Codebook codebook({3, 3, 3}, Warp::flat, 4000);
    const auto disagreement = [&](uint32_t refinements) {
        patches.group(codebook, refinements, {});
        std::vector<Vec3d> means(patches.patch_count());
        const auto normal = [&](uint32_t t) {
            const auto at = [&](uint32_t k) { return mesh.position(mesh.corner_vertex(3 * t + k)); };
            return normalized(cross(at(1) - at(0), at(2) - at(0)));
        };
        for (uint32_t t = 0; t < mesh.triangle_count(); ++t)
            means[patches.patch(t)] = means[patches.patch(t)] + normal(t);
        double sum = 0;
        for (uint32_t t = 0; t < mesh.triangle_count(); ++t)
            sum += std::acos(std::min(1.0, dot(normalized(means[patches.patch(t)]), normal(t))));
        return sum;
    };
    EXPECT_LT(disagreement(1), disagreement(0));
    EXPECT_LT(disagreement(3), disagreement(1));
}

TEST(Gaea, leaves_of_a_box_the_vertices_of_its_edges) {
    const Mesh box = shapes::box({.cells = 4, .faceted = false});
    for (const char* remesh : {"collapse", "triangulate"}) {
        const Simplified s = simplify(box, {}, {{"n", 1.0}, {"remesh", remesh}});
        EXPECT_EQ(s.mesh.triangle_count(), 192 - 2 * 6 * 9U) << remesh;
        EXPECT_EQ(s.stop_reason, StopReason::threshold);
        EXPECT_EQ(s.threshold_used, 1);
        EXPECT_NEAR(s.error_model_units, 0, 1e-6);
        std::set<std::array<float, 3>> kept;
        for (const Vec3f p : s.mesh.positions) kept.insert({p.x, p.y, p.z});
        for (const Vec3f p : box.positions) {
            const auto on_side = [](float x) { return std::abs(std::abs(x) - 0.5F) < 1e-6F; };
            if (on_side(p.x) + on_side(p.y) + on_side(p.z) < 2) continue;
            EXPECT_TRUE(kept.contains({p.x, p.y, p.z}));
        }
    }
}

TEST(Gaea, leaves_more_with_more_code_vectors) {
    size_t last = 0;
    for (const double n : {1.0, 3.0, 5.0, 9.0}) {
        const size_t now = left(ball(), {{"n", n}});
        EXPECT_GT(now, last) << n;
        EXPECT_EQ(now % 2, 0U);
        last = now;
    }
    EXPECT_LT(last, ball().triangle_count());
}

TEST(Gaea, never_leaves_more_by_iterations_than_by_one_pass) {
    for (const Mesh& mesh : {ball(), shapes::torus(), shapes::box({.cells = 6})}) {
        for (const double n : {1.0, 3.0, 5.0})
            EXPECT_LE(left(mesh, {{"n", n}, {"iterate", true}}), left(mesh, {{"n", n}}));
        EXPECT_LE(left(mesh, {{"schema", "xyz"}, {"iterate", true}}),
                  left(mesh, {{"schema", "xyz"}, {"iterate", false}}));
    }
    EXPECT_EQ(simplify(ball(), {}, {{"iterate", true}}).threshold_used, 1);
    EXPECT_EQ(simplify(ball(), {}, {{"schema", "xyz"}, {"iterate", true}}).threshold_used, 6);
}

TEST(Gaea, finds_the_codebook_for_a_target) {
    for (const double part : {0.8, 0.5, 0.3}) {
        const auto target = static_cast<uint64_t>(part * static_cast<double>(ball().triangle_count()));
        for (const char* schema : {"uniform", "xyz"}) {
            const Simplified s = simplify(ball(), {.triangles = target}, {{"schema", schema}});
            EXPECT_EQ(s.stop_reason, StopReason::target) << part << schema;
            EXPECT_GE(s.mesh.triangle_count() + 2, target);
        }
    }
    const auto used = [](uint64_t triangles) {
        return *simplify(ball(), {.triangles = triangles}).threshold_used;
    };
    EXPECT_GT(used(4200), used(2000)) << "a finer one keeps more";
}

TEST(Gaea, keeps_to_the_threshold_where_a_target_would_go_further) {
    const Simplified bound = simplify(ball(), {.triangles = 100}, {{"n", 5.0}});
    EXPECT_EQ(bound.stop_reason, StopReason::threshold);
    EXPECT_EQ(bound.threshold_used, 5);
    EXPECT_EQ(bound.mesh.triangle_count(), left(ball(), {{"n", 5.0}}));
    const Simplified once = simplify(ball(), {.triangles = 100}, {{"iterate", false}});
    EXPECT_EQ(once.stop_reason, StopReason::threshold);
    EXPECT_EQ(once.mesh.triangle_count(), left(ball(), {{"n", 1.0}}));
    const Simplified wide = simplify(ball(), {.triangles = 4000}, {{"n", 2.0}});
    EXPECT_EQ(wide.stop_reason, StopReason::target);
    EXPECT_GT(*wide.threshold_used, 2) << "a finer one is enough";
}

TEST(Gaea, stops_at_a_number_of_vertices_too) {
    const Simplified s = simplify(ball(), {.vertices = 1500});
    EXPECT_EQ(s.stop_reason, StopReason::target);
    EXPECT_EQ(s.mesh.vertex_count(), 1500U);
}

TEST(Gaea, stops_at_an_error) {
    const double error = 0.001 * bounds(ball().positions).diagonal();
    const Simplified s = simplify(ball(), {.error_model_units = error});
    EXPECT_EQ(s.stop_reason, StopReason::error_limit);
    EXPECT_LE(s.error_model_units, error);
    EXPECT_LT(s.mesh.triangle_count(), ball().triangle_count());
}

TEST(Gaea, triangulates_patches_with_larger_angles_than_collapses_leave) {
    const auto mean_smallest_angle = [](const Mesh& m) {
        double sum = 0;
        for (size_t t = 0; t < m.triangle_count(); ++t) {
            double least = std::numbers::pi;
            for (size_t k = 0; k < 3; ++k) {
                const Vec3d p = m.corner_position(t, k);
                const Vec3d a = m.corner_position(t, (k + 1) % 3) - p,
                            b = m.corner_position(t, (k + 2) % 3) - p;
                least = std::min(least, std::atan2(length(cross(a, b)), dot(a, b)));
            }
            sum += least;
        }
        return sum / static_cast<double>(m.triangle_count());
    };
    const Mesh collapsed = simplify(ball(), {}, {{"n", 2.0}}).mesh;
    const Mesh triangulated = simplify(ball(), {}, {{"n", 2.0}, {"remesh", "triangulate"}}).mesh;
    EXPECT_EQ(triangulated.triangle_count(), collapsed.triangle_count());
    EXPECT_GT(mean_smallest_angle(triangulated), 1.03 * mean_smallest_angle(collapsed));
}

TEST(Gaea, keeps_the_surface_sound_in_every_mode) {
    const Mesh hills = shapes::grid({.height = 0.1, .normals = true, .uvs = true, .colors = true});
    for (const Mesh& mesh :
         {shapes::blob(), hills, shapes::cylinder(), shapes::sphere({.materials = 3}), shapes::fin()}) {
        for (const Parameters& parameters : std::initializer_list<Parameters>{
                 {{"remesh", "triangulate"}},
                 {{"remesh", "triangulate"}, {"schema", "xyz"}, {"warp", "tan"}, {"refine", 0.0}},
                 {{"schema", "xyz"}, {"xyz", "1-2-9"}},
                 {{"iterate", true}, {"refine", 3.0}},
                 {{"n", 1.0}, {"warp", "tan"}}}) {
            const Simplified s = simplify(mesh, {}, parameters);
            EXPECT_TRUE(is_consistent(s.mesh));
            EXPECT_TRUE(test::has_no_new_non_manifold_edge(mesh, s.mesh));
            EXPECT_TRUE(test::has_no_flipped_triangle(mesh, s.mesh));
            EXPECT_TRUE(test::keeps_borders(mesh, s.mesh, 0.05));
            EXPECT_TRUE(test::keeps_uv_orientation(mesh, s.mesh));
            const Bounds before = bounds(mesh.positions), after = bounds(s.mesh.positions);
            EXPECT_LT(length(after.max - before.max) + length(after.min - before.min),
                      0.02 * before.diagonal());
        }
    }
}

TEST(Gaea, starts_a_patch_without_an_edge_from_an_outermost_vertex) {
    const Mesh mesh = pillow();
    const Simplified s = simplify(mesh, {}, {{"n", 1.0}});
    EXPECT_LT(s.mesh.triangle_count(), mesh.triangle_count());
}

TEST(Gaea, returns_what_it_cannot_treat_unchanged_with_the_reason) {
    const Mesh square = shapes::grid({.columns = 1, .rows = 1});
    const Simplified locked = simplify(square, {.triangles = 1});
    EXPECT_EQ(locked.stop_reason, StopReason::locked);
    EXPECT_EQ(locked.mesh.triangles, square.triangles);
    const Mesh tetrahedron = shapes::tetrahedron();
    const Simplified held = simplify(tetrahedron, {.triangles = 2});
    EXPECT_EQ(held.stop_reason, StopReason::threshold);
    EXPECT_EQ(held.mesh.triangles, tetrahedron.triangles);
}

}  // namespace
}  // namespace coppice
