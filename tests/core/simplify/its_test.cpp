#include "core/simplify/its.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <tuple>

#include "core/base/error.h"
#include "core/mesh/adjacency.h"
#include "core/mesh/weld.h"
#include "core/simplify/edge_collapse.h"
#include "core/simplify/unified_error.h"
#include "tests/core/simplify/run_algorithm.h"
#include "tests/support/properties.h"
#include "tests/support/shapes.h"
#include "tests/support/surface.h"

namespace coppice {
namespace {

using test::Parameters;

Simplified simplify(const Mesh& mesh, const Target& target, const Parameters& parameters = {}) {
    return test::run_algorithm(its(), mesh, target, parameters);
}

Simplified halve(const Mesh& mesh) {
    return simplify(mesh, {.triangles = mesh.triangle_count() / 2});
}

double area(const Mesh& mesh) {
    double sum = 0;
    for (size_t t = 0; t < mesh.triangle_count(); ++t) {
        const Vec3d a = mesh.corner_position(t, 0);
        sum += length(cross(mesh.corner_position(t, 1) - a, mesh.corner_position(t, 2) - a)) / 2;
    }
    return sum;
}

// All values of a wedge, its position first.
std::set<std::vector<float>> wedges_of(const Mesh& mesh) {
    std::set<std::vector<float>> all;
    for (size_t w = 0; w < mesh.wedge_count(); ++w) {
        const Vec3f p = mesh.positions[mesh.wedge_vertex[w]];
        std::vector<float> values = {p.x, p.y, p.z};
        for (const Attribute& a : mesh.attributes) {
            const auto from = a.values.begin() + static_cast<ptrdiff_t>(w * a.components);
            values.insert(values.end(), from, from + a.components);
        }
        all.insert(values);
    }
    return all;
}

TEST(Its, gives_only_wedges_that_were_there) {
    const Mesh hills = shapes::grid({.height = 0.1, .normals = true, .uvs = true, .colors = true});
    const auto before = wedges_of(hills), after = wedges_of(halve(hills).mesh);
    EXPECT_TRUE(std::includes(before.begin(), before.end(), after.begin(), after.end()));
}

TEST(Its, keeps_joints_weights_and_morph_deltas_at_their_vertices) {
    const Mesh strip = simplify(shapes::skinned_strip(), {.triangles = 20}).mesh;
    const std::vector<float>& weights = strip.find_attribute("WEIGHTS_0")->values;
    const std::vector<float>& lift = strip.morph_targets[0].deltas[0].values;
    for (size_t w = 0; w < strip.wedge_count(); ++w) {
        const float x = strip.positions[strip.wedge_vertex[w]].x / 4;
        EXPECT_FLOAT_EQ(weights[4 * w + 1], x);
        EXPECT_FLOAT_EQ(lift[3 * w + 1], x * x);
    }
}

TEST(Its, keeps_the_uv_seam_of_a_cylinder) {
    const Mesh cylinder = halve(shapes::cylinder()).mesh;
    const std::vector<float>& uv = cylinder.find_attribute("TEXCOORD_0")->values;
    std::map<uint32_t, std::set<float>> u;  // of the vertices that have 0 or 1
    for (size_t w = 0; w < cylinder.wedge_count(); ++w) {
        if (uv[2 * w] == 0 || uv[2 * w] == 1) u[cylinder.wedge_vertex[w]].insert(uv[2 * w]);
    }
    EXPECT_GE(u.size(), 2U);
    for (const auto& [vertex, values] : u) EXPECT_EQ(values, (std::set<float>{0, 1}));
}

TEST(Its, leaves_no_crack_between_two_materials) {
    const Mesh before = shapes::sphere({.materials = 2});
    const Mesh after = simplify(before, {.triangles = 60}).mesh;
    EXPECT_EQ(topology(after).border_edges, 0U);
    for (const uint32_t slot : {0U, 1U}) {
        EXPECT_GT(std::count(after.triangle_slot.begin(), after.triangle_slot.end(), slot), 20);
    }
}

TEST(Its, never_gives_a_slot_wedges_of_another_slot) {
    // The second material's triangles have no normals: wedges of their own, with zeros.
    Mesh mesh = shapes::sphere({.materials = 2});
    mesh.slots[1].has_attribute = {false};
    std::map<uint32_t, uint32_t> copies;
    for (size_t corner = 0; corner < mesh.triangles.size(); ++corner) {
        if (mesh.triangle_slot[corner / 3] == 0) continue;
        const auto [copy, added] =
            copies.try_emplace(mesh.triangles[corner], static_cast<uint32_t>(mesh.wedge_count()));
        if (added) {
            mesh.wedge_vertex.push_back(mesh.wedge_vertex[mesh.triangles[corner]]);
            mesh.attributes[0].values.insert(mesh.attributes[0].values.end(), {0, 0, 0});
        }
        mesh.triangles[corner] = copy->second;
    }
    drop_unused(mesh);
    const Simplified s = simplify(mesh, {.triangles = 60});
    EXPECT_EQ(s.stop_reason, StopReason::target);
    for (size_t corner = 0; corner < s.mesh.triangles.size(); ++corner) {
        const float* n = s.mesh.attributes[0].values.data() + 3 * size_t{s.mesh.triangles[corner]};
        const bool has_normal = n[0] != 0 || n[1] != 0 || n[2] != 0;
        EXPECT_EQ(has_normal, s.mesh.triangle_slot[corner / 3] == 0);
    }
}

TEST(Its, reduces_a_faceted_box_to_its_twelve_triangles) {
    const Simplified s = simplify(shapes::box({.cells = 8}), {.triangles = 12});
    EXPECT_EQ(s.mesh.triangle_count(), 12U);
    EXPECT_NEAR(area(s.mesh), 6, 1e-6);
    EXPECT_LT(s.error_model_units, 1e-6);
    EXPECT_EQ(s.mesh.wedge_count(), 24U) << "every corner has the normals of its three sides";
}

TEST(Its, keeps_flat_ground_exactly) {
    const Simplified s = simplify(shapes::grid({.columns = 20, .rows = 20}), {.triangles = 40});
    EXPECT_NEAR(area(s.mesh), 1, 1e-6);
    EXPECT_LT(s.error_model_units, 1e-6);
}

TEST(Its, reduces_two_sheets_back_to_back) {
    Mesh leaf = shapes::grid({.height = 0.1});
    const std::vector<uint32_t> front = leaf.triangles;
    for (size_t t = 0; t < front.size(); t += 3) {
        leaf.triangles.insert(leaf.triangles.end(), {front[t], front[t + 2], front[t + 1]});
        leaf.triangle_slot.push_back(0);
    }
    const Simplified s = halve(leaf);
    EXPECT_EQ(s.stop_reason, StopReason::target);
    EXPECT_NEAR(area(s.mesh), area(leaf), 0.02 * area(leaf));
}

TEST(Its, is_not_slowed_down_by_a_vertex_of_very_many_triangles) {
    // A flat disc as one fan: each step must not look at all of it.
    constexpr uint32_t slices = 20000;
    Mesh disc;
    disc.positions.push_back({0, 0, 0});
    for (uint32_t i = 0; i < slices; ++i) {
        const double angle = 2 * 3.14159265358979 * i / slices;
        disc.positions.push_back(to_float({std::cos(angle), std::sin(angle), 0}));
        disc.triangles.insert(disc.triangles.end(), {0, 1 + i, 1 + (i + 1) % slices});
        disc.triangle_slot.push_back(0);
    }
    for (uint32_t v = 0; v <= slices; ++v) disc.wedge_vertex.push_back(v);
    disc.slots.push_back({});
    const Simplified s = simplify(disc, {.triangles = slices / 10});
    EXPECT_EQ(s.mesh.triangle_count(), slices / 10);
    EXPECT_NEAR(area(s.mesh), 3.14159, 1e-4);
}

TEST(Its, stops_before_the_error_limit) {
    const Simplified s = simplify(shapes::sphere({.segments = 60, .rings = 30}), {.error_model_units = 0.02});
    EXPECT_EQ(s.stop_reason, StopReason::error_limit);
    EXPECT_LE(s.error_model_units, 0.02);
    EXPECT_GT(s.error_model_units, 0.01);
    EXPECT_LT(s.mesh.triangle_count(), 1700U);
    EXPECT_FALSE(s.certified);
}

TEST(Its, stops_at_whatever_is_reached_first) {
    const Mesh sphere = shapes::sphere();
    const Simplified s = simplify(sphere, {.triangles = 100, .error_model_units = 10});
    EXPECT_EQ(s.stop_reason, StopReason::target);
    EXPECT_EQ(s.mesh.triangle_count(), 100U);
}

TEST(Its, collapses_nothing_beyond_the_largest_geometric_error) {
    const Simplified s =
        simplify(shapes::sphere(), {}, {{"max_geometric_error", 0.005}, {"normal_scale", 0.0}});
    EXPECT_EQ(s.stop_reason, StopReason::threshold);
    EXPECT_LT(s.mesh.triangle_count(), 528U);
    EXPECT_GT(s.mesh.triangle_count(), 100U);
}

TEST(Its, keeps_more_of_what_the_scales_make_dear) {
    // Flat, but coloured from left to right: only colour keeps triangles there.
    Mesh flat = shapes::grid({.columns = 24, .rows = 24, .colors = true});
    std::vector<float>& colors = flat.attributes[0].values;
    for (size_t w = 0; w < flat.wedge_count(); ++w) {
        const float x = flat.positions[flat.wedge_vertex[w]].x;
        colors[3 * w] = x < 0.5F ? 0 : std::sin(40 * x);
    }
    const auto right_half = [&flat](double color_scale) {
        const Mesh m = simplify(flat, {.triangles = 300}, {{"color_scale", color_scale}}).mesh;
        return std::count_if(m.positions.begin(), m.positions.end(), [](Vec3f p) { return p.x > 0.5F; });
    };
    EXPECT_GT(right_half(1), 1.15 * static_cast<double>(right_half(0)));
}

TEST(Its, estimates_the_deviation_that_a_measurement_finds) {
    const Mesh hills = shapes::grid({.columns = 40, .rows = 40, .height = 0.1});
    const Simplified s = simplify(hills, {.triangles = 400});
    const test::Surface after(s.mesh);
    double measured = 0;
    for (const Vec3f p : hills.positions) measured = std::max(measured, after.distance_to(to_double(p)));
    EXPECT_GT(s.error_model_units, 0.7 * measured);
    EXPECT_LT(s.error_model_units, 4 * measured);
}

// Two sheets without a common vertex: ripples of one height, in one facing x, in the other facing y.
Mesh ripples() {
    Mesh mesh = shapes::grid({.columns = 24, .rows = 24});
    const auto count = static_cast<uint32_t>(mesh.vertex_count());
    for (uint32_t v = 0; v < count; ++v) {
        const Vec3f p = mesh.positions[v];
        const float height = 0.02F * std::sin(25 * p.x) * std::sin(25 * p.z);
        mesh.positions[v].y = height;
        mesh.positions.push_back({-1 - height, p.x, p.z});
        mesh.wedge_vertex.push_back(count + v);
    }
    const std::vector<uint32_t> sheet = mesh.triangles;
    for (const uint32_t wedge : sheet) mesh.triangles.push_back(count + wedge);
    mesh.triangle_slot.resize(2 * mesh.triangle_slot.size(), 0);
    return mesh;
}

Mesh halve_for(const Mesh& mesh, const std::vector<Transform>& instances) {
    const Algorithm algorithm = its();
    return algorithm
        .simplify(mesh, instances, {.triangles = mesh.triangle_count() / 2},
                  ParameterValues::parse(algorithm.parameters, {}), {})
        .mesh;
}

TEST(Its, keeps_more_of_what_its_instances_stretch) {
    const auto facing_x = [](const Mesh& mesh) {
        return std::count_if(mesh.positions.begin(), mesh.positions.end(), [](Vec3f p) { return p.x < 0; });
    };
    const Mesh mesh = ripples();
    const auto usually = static_cast<double>(facing_x(halve_for(mesh, {})));
    const Transform along_x = from_trs({}, {0, 0, 0, 1}, {4, 1, 1});
    const Transform along_y = from_trs({}, {0, 0, 0, 1}, {1, 4, 1});
    EXPECT_GT(facing_x(halve_for(mesh, {along_x})), 1.3 * usually);
    EXPECT_LT(facing_x(halve_for(mesh, {along_y})), 0.7 * usually);
}

TEST(Its, gives_the_same_for_any_instances_that_stretch_nothing) {
    const Mesh mesh = ripples();
    std::vector<Transform> instances;
    for (int i = 0; i < 100; ++i) {
        instances.push_back(from_trs({1.0 * i, 0, 0}, {0.1 * i, 0.3, 0, 1}, {0.1 + i, 0.1 + i, 0.1 + i}));
    }
    const Mesh alone = halve_for(mesh, {}), many = halve_for(mesh, instances);
    EXPECT_EQ(many.triangles, alone.triangles);
    EXPECT_EQ(many.positions, alone.positions);
}

TEST(Its, halves_a_surface_with_a_decal_and_keeps_both_on_each_other) {
    Mesh mesh = shapes::cylinder({.segments = 32, .rows = 16});
    mesh.slots.push_back({});
    const std::vector<uint32_t> surface = mesh.triangles;
    mesh.triangles.insert(mesh.triangles.end(), surface.begin(), surface.end());
    mesh.triangle_slot.resize(2 * mesh.triangle_slot.size(), 1);
    const Simplified s = halve(mesh);
    EXPECT_EQ(s.stop_reason, StopReason::target);
    std::map<uint32_t, std::set<std::set<uint32_t>>> layers;
    for (size_t t = 0; t < s.mesh.triangle_count(); ++t) {
        layers[s.mesh.triangle_slot[t]].insert(
            {s.mesh.corner_vertex(t, 0), s.mesh.corner_vertex(t, 1), s.mesh.corner_vertex(t, 2)});
    }
    EXPECT_EQ(layers[0], layers[1]);
    EXPECT_TRUE(test::keeps_seams(mesh, s.mesh, 0.05));
    EXPECT_TRUE(test::keeps_borders(mesh, s.mesh, 0.05));
}

TEST(Its, turns_no_triangle_around_since_the_start) {
    // Seen from inside, where each triangle is still known by its number.
    for (const Mesh& mesh : {shapes::blob({.segments = 40, .rings = 30}), shapes::box({.cells = 8}),
                             shapes::torus(), shapes::grid({.height = 0.1, .uvs = true})}) {
        const Target target = {.triangles = mesh.triangle_count() / 10};
        const auto make_error = [](const CollapseParts& parts) {
            return std::make_unique<UnifiedError>(parts, UnifiedOptions{}, Watch{});
        };
        EdgeCollapse work(mesh, target, {.freedom = Freedom::end_point}, make_error, {});
        const Watch watch;
        CheapestFirst(work, watch).run();
        const CollapseMesh before(mesh);
        for (uint32_t t = 0; t < before.triangle_count(); ++t) {
            if (!work.mesh().is_live_triangle(t)) continue;
            const auto normal = [t](const CollapseMesh& m) {
                const Vec3d a = m.position(m.corner_vertex(3 * t));
                return cross(m.position(m.corner_vertex(3 * t + 1)) - a,
                             m.position(m.corner_vertex(3 * t + 2)) - a);
            };
            ASSERT_GT(dot(normal(work.mesh()), normal(before)), 0) << "triangle " << t;
        }
    }
}

TEST(Its, stops_before_it_has_built_anything) {
    std::stop_source stop;
    stop.request_stop();
    const Watch stopped = {.stop = stop.get_token()};
    const Mesh mesh = shapes::cylinder();
    EXPECT_THROW(CollapseMesh(mesh, stopped), Error);
    const CollapseMesh collapsing(mesh);
    EXPECT_THROW(AttributeClouds(collapsing, mesh, {}, stopped), Error);
    EXPECT_THROW(CollapseRules(collapsing, {}, stopped), Error);
    EXPECT_THROW(UvGuard(collapsing, mesh, stopped), Error);
    EXPECT_THROW(collapsing.extract(mesh, stopped), Error);
}

TEST(Its, has_nothing_to_do_on_an_empty_mesh) {
    Mesh empty;
    empty.slots.push_back({});
    const Simplified s = simplify(empty, {.triangles = 0});
    EXPECT_EQ(s.mesh.triangle_count(), 0U);
    EXPECT_EQ(s.stop_reason, StopReason::already_smaller);
}

TEST(Its, drops_triangles_without_three_vertices) {
    Mesh mesh = shapes::sphere();
    for (int i = 0; i < 5; ++i) {
        mesh.triangles.insert(mesh.triangles.end(), {0, 0, 1});
        mesh.triangle_slot.push_back(0);
    }
    EXPECT_EQ(simplify(mesh, {.triangles = 200}).mesh.triangle_count(), 200U);
}

TEST(Its, survives_triangles_without_area_and_doubled_ones) {
    Mesh mesh = shapes::grid({.height = 0.1});
    for (size_t t = 0; t < 30; ++t) {  // three vertices of one straight line; and the same triangle twice
        const auto v = static_cast<uint32_t>(t);
        mesh.triangles.insert(mesh.triangles.end(), {v, v + 1, v + 2});
        const std::vector<uint32_t> twin(mesh.triangles.begin() + static_cast<ptrdiff_t>(30 * t),
                                         mesh.triangles.begin() + static_cast<ptrdiff_t>(30 * t + 3));
        mesh.triangles.insert(mesh.triangles.end(), twin.begin(), twin.end());
        mesh.triangle_slot.insert(mesh.triangle_slot.end(), 2, 0);
    }
    const Simplified s = halve(mesh);
    EXPECT_TRUE(is_consistent(s.mesh));
    EXPECT_LE(topology(s.mesh).non_manifold_edges, topology(mesh).non_manifold_edges);
    EXPECT_TRUE(s.stop_reason == StopReason::target || s.mesh.triangle_count() > mesh.triangle_count() / 2);
}

// The paper's Table 2 on a mesh of its bunny's size: the stop is on vertices, at 10, 20 and 50 % removed.
struct Row {
    double removed;
    double vertices, triangles;
};
class ItsTable2 : public testing::TestWithParam<std::tuple<std::string, Row>> {};

TEST_P(ItsTable2, leaves_as_many_vertices_and_triangles_as_printed) {
    const auto& [mode, row] = GetParam();
    const Mesh bunny_sized = shapes::blob();
    ASSERT_EQ(bunny_sized.vertex_count(), 2503U);
    const auto target = static_cast<uint64_t>(2503 * (1 - row.removed));
    const Simplified s = simplify(bunny_sized, {.vertices = target}, {{"mode", mode}, {"stop", "vertices"}});
    EXPECT_EQ(s.stop_reason, StopReason::target);
    EXPECT_LE(s.mesh.vertex_count(), target);
    EXPECT_NEAR(static_cast<double>(s.mesh.vertex_count()), row.vertices, 0.02 * row.vertices);
    EXPECT_NEAR(static_cast<double>(s.mesh.triangle_count()), row.triangles, 0.06 * row.triangles);
}

INSTANTIATE_TEST_SUITE_P(Bunny, ItsTable2,
                         testing::Combine(testing::Values("full", "faithful"),
                                          testing::Values(Row{0.1, 2247, 4456}, Row{0.2, 1998, 3958},
                                                          Row{0.5, 1244, 2448})));

TEST(Its, faithful_mode_collapses_short_edges_rather_than_cheap_ones) {
    // Fine flat ground on one side, coarse hills on the other: full takes the flat side, faithful too, as it
    // is fine; with the hills fine and the flat side coarse they differ.
    Mesh mesh = shapes::grid({.columns = 40, .rows = 10});
    for (Vec3f& p : mesh.positions) {
        if (p.x < 0.5F) p.y = 0.02F * std::sin(60 * p.x) * std::sin(20 * p.z);
        if (p.x > 0.5F) p.x = 0.5F + 4 * (p.x - 0.5F);
    }
    const auto on_hills = [&mesh](const char* mode) {
        const Mesh m = simplify(mesh, {.triangles = 400}, {{"mode", mode}}).mesh;
        return std::count_if(m.positions.begin(), m.positions.end(), [](Vec3f p) { return p.x < 0.5F; });
    };
    EXPECT_GT(on_hills("full"), 1.3 * static_cast<double>(on_hills("faithful")));
}

}  // namespace
}  // namespace coppice
