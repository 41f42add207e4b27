// What every algorithm of the registry must leave true, on every shape.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <set>
#include <string>
#include <tuple>

#include "core/base/error.h"
#include "core/mesh/adjacency.h"
#include "core/sample/sample.h"
#include "core/simplify/registry.h"
#include "tests/core/simplify/variants.h"
#include "tests/support/properties.h"
#include "tests/support/shapes.h"

namespace coppice {
namespace {

struct NamedMesh {
    const char* name;
    Mesh mesh;
    bool is_surface = true;   // has an outside, and borders that are lines
    bool is_cracked = false;  // has borders that may close

    bool has_texture() const { return mesh.find_attribute("TEXCOORD_0") != nullptr; }
};

const std::vector<NamedMesh>& drawn() {
    static const std::vector<NamedMesh> list = {
        {"sphere", shapes::sphere()},
        {"sphere_of_two_materials", shapes::sphere({.materials = 2})},
        {"sphere_of_three_materials", shapes::sphere({.materials = 3})},
        {"cylinder_with_a_seam", shapes::cylinder()},
        {"open_grid", shapes::grid()},
        {"hills", shapes::grid({.height = 0.1, .normals = true, .uvs = true, .colors = true})},
        {"torus", shapes::torus()},
        {"box", shapes::box({.faceted = false})},
        {"faceted_box", shapes::box()},
        {"faceted_sphere", shapes::faceted_sphere()},
        {"blob", shapes::blob({.segments = 40, .rings = 30})},
        {"tetrahedron", shapes::tetrahedron()},
        {"soup", shapes::soup(), false},
        {"fin", shapes::fin()},
        {"tiles", shapes::tiles({.columns = 4, .rows = 3, .cells = 4, .gap = 0.02}), true, true},
        {"skinned_strip", shapes::skinned_strip()},
    };
    return list;
}

// Degenerate triangles of the original may stay.
testing::AssertionResult has_sound_triangles(const Mesh& before, const Mesh& after) {
    const auto degenerate = [](const Mesh& m) {
        size_t count = 0;
        for (size_t t = 0; t < m.triangle_count(); ++t) {
            const Vec3d a = m.corner_position(t, 0), b = m.corner_position(t, 1), c = m.corner_position(t, 2);
            const double longest =
                std::max({squared_length(b - a), squared_length(c - b), squared_length(a - c)});
            count += length(cross(b - a, c - a)) > 1e-7 * longest ? 0 : 1;
        }
        return count;
    };
    const auto duplicate = [](const Mesh& m) {
        std::set<std::array<uint32_t, 3>> seen;
        for (size_t t = 0; t < m.triangle_count(); ++t) {
            std::array<uint32_t, 3> v = {m.corner_vertex(t, 0), m.corner_vertex(t, 1), m.corner_vertex(t, 2)};
            std::sort(v.begin(), v.end());
            seen.insert(v);
        }
        return m.triangle_count() - seen.size();
    };
    if (degenerate(after) > degenerate(before))
        return testing::AssertionFailure() << degenerate(after) << " triangles are degenerate";
    if (duplicate(after) > duplicate(before))
        return testing::AssertionFailure() << duplicate(after) << " triangles lie on others";
    return testing::AssertionSuccess();
}

// Finite, and normals of unit length.
testing::AssertionResult has_sound_values(const Mesh& mesh) {
    for (const Vec3f p : mesh.positions)
        if (!std::isfinite(p.x + p.y + p.z)) return testing::AssertionFailure() << "a position is not finite";
    for (const Attribute& a : mesh.attributes) {
        for (const float value : a.values)
            if (!std::isfinite(value)) return testing::AssertionFailure() << a.name << " is not finite";
        if (a.name != "NORMAL") continue;
        for (size_t w = 0; w < mesh.wedge_count(); ++w) {
            const Vec3d n = {double{a.values[3 * w]}, double{a.values[3 * w + 1]},
                             double{a.values[3 * w + 2]}};
            if (std::abs(length(n) - 1) > 1e-3)
                return testing::AssertionFailure() << "a normal has the length " << length(n);
        }
    }
    return testing::AssertionSuccess();
}

void expect_target(const Mesh& mesh, double ratio, const Simplified& s) {
    const double target = ratio * static_cast<double>(mesh.triangle_count());
    const auto triangles = static_cast<double>(s.mesh.triangle_count());
    if (s.stop_reason == StopReason::target) {
        EXPECT_NEAR(triangles, target, std::max(2.0, 0.01 * target));
    } else {
        EXPECT_GT(triangles, target) << name(s.stop_reason);
        EXPECT_NE(s.stop_reason, StopReason::already_smaller);
    }
}

// Within 2 % of the diagonal, or what the algorithm declares.
void expect_box(const Algorithm& algorithm, const Mesh& before, const Mesh& after) {
    const Bounds old = bounds(before.positions), now = bounds(after.positions);
    const double allowed = std::max(0.02, algorithm.bounds_tolerance_of_diagonal) * old.diagonal();
    EXPECT_LT(length(now.min - old.min), allowed);
    EXPECT_LT(length(now.max - old.max), allowed);
}

constexpr double line_tolerance = 0.05;  // of the diagonal, whatever the ratio

class EveryAlgorithm : public testing::TestWithParam<std::tuple<test::Variant, size_t>> {
  protected:
    const test::Variant& variant() const { return std::get<0>(GetParam()); }
    const Mesh& mesh() const { return drawn()[std::get<1>(GetParam())].mesh; }
    const char* shape() const { return drawn()[std::get<1>(GetParam())].name; }

    template <typename Check>
    void at_every_ratio(Check check) {
        for (const double ratio : {0.9, 0.8, 0.5, 0.3, 0.1}) {
            SCOPED_TRACE(testing::Message() << shape() << " at " << ratio);
            check(ratio, test::simplify(variant(), mesh(), test::part_of(mesh(), ratio)));
        }
    }

    void expect_target(double ratio, const Simplified& s) const { coppice::expect_target(mesh(), ratio, s); }
};

// What holds on some shapes only is not asked of the others. Soup has no outside that a triangle could be
// flipped from, and is nothing but borders; without texture coordinates there are no seams of them.
class EveryAlgorithmOnSurfaces : public EveryAlgorithm {};
class EveryAlgorithmOnTextures : public EveryAlgorithm {};

TEST_P(EveryAlgorithm, gives_a_consistent_mesh_without_what_is_unused) {
    at_every_ratio([&](double, const Simplified& s) {
        EXPECT_TRUE(is_consistent(s.mesh));
        std::vector<bool> wedge_used(s.mesh.wedge_count()), vertex_used(s.mesh.vertex_count());
        for (const uint32_t wedge : s.mesh.triangles) {
            wedge_used[wedge] = true;
            vertex_used[s.mesh.wedge_vertex[wedge]] = true;
        }
        EXPECT_EQ(std::count(wedge_used.begin(), wedge_used.end(), false), 0);
        EXPECT_EQ(std::count(vertex_used.begin(), vertex_used.end(), false), 0);
        EXPECT_EQ(s.mesh.attributes.size(), mesh().attributes.size());
        EXPECT_EQ(s.mesh.morph_targets.size(), mesh().morph_targets.size());
        EXPECT_EQ(s.mesh.slots.size(), mesh().slots.size());
    });
}

TEST_P(EveryAlgorithm, meets_the_target_or_says_why_not) {
    at_every_ratio([&](double ratio, const Simplified& s) { expect_target(ratio, s); });
}

TEST_P(EveryAlgorithm, makes_no_triangle_degenerate_or_duplicate) {
    at_every_ratio([&](double, const Simplified& s) { EXPECT_TRUE(has_sound_triangles(mesh(), s.mesh)); });
}

TEST_P(EveryAlgorithm, gives_finite_values_and_unit_normals) {
    at_every_ratio([&](double, const Simplified& s) { EXPECT_TRUE(has_sound_values(s.mesh)); });
}

TEST_P(EveryAlgorithm, makes_no_edge_non_manifold) {
    at_every_ratio([&](double, const Simplified& s) {
        EXPECT_TRUE(test::has_no_new_non_manifold_edge(mesh(), s.mesh));
    });
}

TEST_P(EveryAlgorithmOnSurfaces, flips_no_triangle) {
    at_every_ratio(
        [&](double, const Simplified& s) { EXPECT_TRUE(test::has_no_flipped_triangle(mesh(), s.mesh)); });
}

TEST_P(EveryAlgorithm, keeps_the_box) {
    at_every_ratio([&](double, const Simplified& s) {
        expect_box(find_algorithm(variant().algorithm), mesh(), s.mesh);
    });
}

// But those of cracks, where the algorithm closes them.
TEST_P(EveryAlgorithmOnSurfaces, keeps_borders) {
    const bool joins = variant().algorithm == "gaps" || variant().parameters.contains("pair_distance");
    if (joins && drawn()[std::get<1>(GetParam())].is_cracked) return;
    at_every_ratio([&](double, const Simplified& s) {
        EXPECT_TRUE(test::keeps_borders(mesh(), s.mesh, line_tolerance));
        if (topology(mesh()).border_edges == 0) {
            EXPECT_EQ(topology(s.mesh).border_edges, 0U);
        }
    });
}

TEST_P(EveryAlgorithmOnTextures, keeps_seams) {
    at_every_ratio([&](double, const Simplified& s) {
        EXPECT_TRUE(test::keeps_seams(mesh(), s.mesh, line_tolerance));
        if (find_algorithm(variant().algorithm).keeps_values) {
            EXPECT_TRUE(test::keeps_charts(mesh(), s.mesh));
        }
        EXPECT_TRUE(test::keeps_uv_orientation(mesh(), s.mesh));
    });
}

TEST_P(EveryAlgorithm, gives_the_same_twice) {
    const Simplified a = test::simplify(variant(), mesh(), test::part_of(mesh(), 0.4));
    const Simplified b = test::simplify(variant(), mesh(), test::part_of(mesh(), 0.4));
    EXPECT_EQ(a.mesh.triangles, b.mesh.triangles);
    EXPECT_EQ(a.mesh.wedge_vertex, b.mesh.wedge_vertex);
    EXPECT_EQ(a.mesh.positions, b.mesh.positions);
    EXPECT_EQ(a.error_model_units, b.error_model_units);
}

TEST_P(EveryAlgorithm, reports_progress_that_never_goes_back) {
    std::vector<double> told;
    test::simplify(variant(), mesh(), test::part_of(mesh(), 0.3),
                   {.progress = [&told](double fraction) { told.push_back(fraction); }});
    ASSERT_FALSE(told.empty());
    EXPECT_TRUE(std::is_sorted(told.begin(), told.end()));
    EXPECT_GE(told.front(), 0);
    EXPECT_EQ(told.back(), 1);
}

TEST_P(EveryAlgorithm, stops_when_it_is_cancelled) {
    std::stop_source stop;
    const Watch watch = {.stop = stop.get_token(), .progress = [&stop](double) { stop.request_stop(); }};
    try {
        test::simplify(variant(), mesh(), test::part_of(mesh(), 0.1), watch);
        FAIL() << "went on";
    } catch (const Error& error) {
        EXPECT_EQ(error.code(), ErrorCode::job_cancelled);
    }
}

TEST_P(EveryAlgorithm, leaves_alone_what_is_small_enough) {
    const Simplified s = test::simplify(variant(), mesh(), {.triangles = mesh().triangle_count()});
    EXPECT_EQ(s.stop_reason, StopReason::already_smaller);
    EXPECT_EQ(s.mesh.triangles, mesh().triangles);
    EXPECT_EQ(s.error_model_units, 0);
}

// Indices in drawn().
template <typename Rule>
std::vector<size_t> shapes_that(Rule rule) {
    std::vector<size_t> indices;
    for (size_t i = 0; i < drawn().size(); ++i)
        if (rule(drawn()[i])) indices.push_back(i);
    return indices;
}

const auto every_variant = testing::ValuesIn(test::variants());

std::string variant_and_shape(const testing::TestParamInfo<std::tuple<test::Variant, size_t>>& tested) {
    return test::test_name(std::get<0>(tested.param), drawn()[std::get<1>(tested.param)].name);
}

INSTANTIATE_TEST_SUITE_P(Registry, EveryAlgorithm,
                         testing::Combine(every_variant, testing::ValuesIn(shapes_that([](const NamedMesh&) {
                                              return true;
                                          }))),
                         variant_and_shape);
INSTANTIATE_TEST_SUITE_P(Registry, EveryAlgorithmOnSurfaces,
                         testing::Combine(every_variant,
                                          testing::ValuesIn(shapes_that([](const NamedMesh& m) {
                                              return m.is_surface;
                                          }))),
                         variant_and_shape);
INSTANTIATE_TEST_SUITE_P(Registry, EveryAlgorithmOnTextures,
                         testing::Combine(every_variant,
                                          testing::ValuesIn(shapes_that([](const NamedMesh& m) {
                                              return m.has_texture();
                                          }))),
                         variant_and_shape);

// All of it at once on the procedural scenes, which have materials, seams, open borders and flat walls.
class EverySample : public testing::TestWithParam<std::tuple<test::Variant, std::string>> {};

TEST_P(EverySample, keeps_what_shapes_keep) {
    const auto& [variant, sample] = GetParam();
    for (const Mesh& mesh : make_sample(sample, {.copies = 2, .triangles = 600}).meshes) {
        for (const double ratio : {0.9, 0.5, 0.1}) {
            SCOPED_TRACE(testing::Message() << sample << ' ' << mesh.name << ", " << mesh.triangle_count()
                                            << " triangles, at " << ratio);
            const Simplified s = test::simplify(variant, mesh, test::part_of(mesh, ratio));
            EXPECT_TRUE(is_consistent(s.mesh));
            expect_target(mesh, ratio, s);
            EXPECT_TRUE(test::has_no_new_non_manifold_edge(mesh, s.mesh));
            EXPECT_TRUE(test::has_no_flipped_triangle(mesh, s.mesh, s.error_model_units));
            EXPECT_TRUE(has_sound_triangles(mesh, s.mesh));
            EXPECT_TRUE(has_sound_values(s.mesh));
            EXPECT_TRUE(test::keeps_borders(mesh, s.mesh, line_tolerance));
            EXPECT_TRUE(test::keeps_seams(mesh, s.mesh, line_tolerance));
            // The second stage of fass knows how the texture is wound only from what the first stage left.
            if (variant.algorithm != "fass") {
                EXPECT_TRUE(test::keeps_uv_orientation(mesh, s.mesh));
            }
            expect_box(find_algorithm(variant.algorithm), mesh, s.mesh);
        }
    }
}

INSTANTIATE_TEST_SUITE_P(Registry, EverySample,
                         testing::Combine(testing::ValuesIn(test::variants()),
                                          testing::Values("forest", "city", "bunny13", "baked", "cad")),
                         [](const testing::TestParamInfo<std::tuple<test::Variant, std::string>>& tested) {
                             return test::test_name(std::get<0>(tested.param), std::get<1>(tested.param));
                         });

class EveryUnguardedMode : public EveryAlgorithm {};

TEST_P(EveryUnguardedMode, gives_a_consistent_mesh_without_degenerate_or_duplicate_triangles) {
    at_every_ratio([&](double, const Simplified& s) {
        EXPECT_TRUE(is_consistent(s.mesh));
        EXPECT_TRUE(has_sound_values(s.mesh));
        EXPECT_EQ(s.mesh.attributes.size(), mesh().attributes.size());
    });
}

// One merge may take many triangles.
TEST_P(EveryUnguardedMode, meets_the_target_or_says_why_not) {
    at_every_ratio([&](double ratio, const Simplified& s) {
        const auto triangles = static_cast<double>(s.mesh.triangle_count());
        const bool met = triangles <= ratio * static_cast<double>(mesh().triangle_count());
        EXPECT_EQ(s.stop_reason == StopReason::target, met) << name(s.stop_reason);
    });
}

TEST_P(EveryUnguardedMode, gives_the_same_twice) {
    const Simplified a = test::simplify(variant(), mesh(), test::part_of(mesh(), 0.4));
    const Simplified b = test::simplify(variant(), mesh(), test::part_of(mesh(), 0.4));
    EXPECT_EQ(a.mesh.triangles, b.mesh.triangles);
    EXPECT_EQ(a.mesh.positions, b.mesh.positions);
}

INSTANTIATE_TEST_SUITE_P(Registry, EveryUnguardedMode,
                         testing::Combine(testing::ValuesIn(test::unguarded_variants()),
                                          testing::Range(size_t{0}, drawn().size())),
                         variant_and_shape);

}  // namespace
}  // namespace coppice
