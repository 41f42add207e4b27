// The parts that algorithms are made of: heap, quadric, clouds, deviation, mesh, rules.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <set>

#include "core/base/watched_loop.h"
#include "core/simplify/attribute_cloud.h"
#include "core/simplify/bounds_guard.h"
#include "core/simplify/collapse_mesh.h"
#include "core/simplify/collapse_rules.h"
#include "core/simplify/deviation.h"
#include "core/simplify/heap.h"
#include "core/simplify/instance_metric.h"
#include "core/simplify/quadric.h"
#include "core/simplify/unified_error.h"
#include "core/simplify/uv_guard.h"
#include "core/simplify/vertex_kind.h"
#include "tests/support/shapes.h"

namespace coppice {
namespace {

TEST(IndexedHeap, agrees_with_a_sorted_set) {
    constexpr uint32_t ids = 50;
    IndexedHeap heap(ids);
    std::set<std::pair<double, uint32_t>> sorted;
    std::vector<double> keys(ids, -1);
    std::mt19937 random(7);
    for (int step = 0; step < 5000; ++step) {
        const auto id = static_cast<uint32_t>(random() % ids);
        sorted.erase({keys[id], id});
        if (random() % 3 == 0) {
            heap.erase(id);
        } else {
            keys[id] = static_cast<double>(random() % 20);  // many ties
            heap.set(id, keys[id]);
            sorted.insert({keys[id], id});
        }
        ASSERT_EQ(heap.size(), sorted.size());
        if (!sorted.empty()) {
            ASSERT_EQ(heap.top(), sorted.begin()->second);
            ASSERT_EQ(heap.top_key(), sorted.begin()->first);
        }
    }
}

TEST(Quadric, is_the_weighted_sum_of_squared_distances_to_planes) {
    const Quadric floor = plane_quadric({0, 1, 0}, {5, 2, 7}, 3);
    const Quadric wall = plane_quadric({1, 0, 0}, {1, 0, 0}, 0.5);
    EXPECT_DOUBLE_EQ(floor({9, 4, 9}), 3 * 4);
    EXPECT_DOUBLE_EQ((floor + wall)({4, 3, 0}), 3 * 1 + 0.5 * 9);
    EXPECT_EQ(plane_quadric({}, {1, 2, 3}, 5)({4, 5, 6}), 0) << "no plane";
}

TEST(Deviation, measures_to_the_face_the_edge_or_the_corner_of_a_triangle) {
    const Vec3d a = {0, 0, 0}, b = {4, 0, 0}, c = {0, 4, 0};
    EXPECT_DOUBLE_EQ(distance_to_triangle({1, 1, -2}, a, b, c), 2);
    EXPECT_DOUBLE_EQ(distance_to_triangle({2, -3, 0}, a, b, c), 3);
    EXPECT_DOUBLE_EQ(distance_to_triangle({-3, -4, 0}, a, b, c), 5);
    EXPECT_DOUBLE_EQ(distance_to_triangle({1, 3, 0}, a, a, a), std::sqrt(10.0));
}

TEST(AttributeClouds, give_the_weighted_squared_distances_of_all_that_was_merged) {
    const Mesh mesh = shapes::grid({.columns = 2, .rows = 2, .uvs = true});
    const CollapseMesh collapsing(mesh);
    AttributeClouds clouds(collapsing, mesh, {.uv = 10.0});
    const Attribute& uv = mesh.attributes[0];
    const auto squared_distance = [&](uint32_t v, uint32_t w) {
        const uint32_t i = collapsing.wedge_source(v), j = collapsing.wedge_source(w);
        const double du = uv.values[2 * i] - uv.values[2 * j];
        const double dv = uv.values[2 * i + 1] - uv.values[2 * j + 1];
        return 100 * (du * du + dv * dv);
    };
    const double expected =
        clouds.weight(0, 0) * squared_distance(0, 2) + clouds.weight(1, 0) * squared_distance(1, 2);
    clouds.merge(0, 1);
    EXPECT_NEAR(clouds.squared_error(1, 2, 0), expected, 1e-9);
    EXPECT_NEAR(clouds.squared_error(1, 2), expected, 1e-9);
}

TEST(CollapseMesh, moves_triangles_and_drops_those_at_the_edge) {
    const Mesh mesh = shapes::sphere({.normals = false});
    CollapseMesh collapsing(mesh);
    const uint32_t removed = 30;
    const uint32_t kept =
        collapsing.corner_vertex(CollapseMesh::next_corner(collapsing.first_corner(removed)));
    const uint32_t together = collapsing.valence(removed) + collapsing.valence(kept);
    collapsing.collapse(removed, kept, {collapsing.wedge_begin(kept)});
    EXPECT_EQ(collapsing.live_triangles(), mesh.triangle_count() - 2);
    EXPECT_EQ(collapsing.live_vertices(), mesh.vertex_count() - 1);
    EXPECT_EQ(collapsing.valence(kept), together - 4);
    EXPECT_FALSE(collapsing.is_live_vertex(removed));
    const Mesh result = collapsing.extract(mesh);
    EXPECT_TRUE(is_consistent(result));
    EXPECT_EQ(result.triangle_count(), mesh.triangle_count() - 2);
    EXPECT_EQ(result.vertex_count(), mesh.vertex_count() - 1);
}

std::map<VertexKind, int> kinds_of(const Mesh& mesh) {
    std::map<VertexKind, int> count;
    for (const VertexKind kind : find_features(CollapseMesh(mesh), {}).kinds) ++count[kind];
    return count;
}

TEST(VertexKinds, tell_borders_seams_and_edges_of_three_triangles_from_the_rest) {
    using Kinds = std::map<VertexKind, int>;
    EXPECT_EQ(kinds_of(shapes::sphere()), (Kinds{{VertexKind::manifold, 266}}));
    EXPECT_EQ(kinds_of(shapes::grid({.columns = 4, .rows = 4})),
              (Kinds{{VertexKind::manifold, 9}, {VertexKind::border, 16}}));
    EXPECT_EQ(kinds_of(shapes::cylinder({.segments = 8, .rows = 4})), (Kinds{{VertexKind::manifold, 21},
                                                                             {VertexKind::border, 14},
                                                                             {VertexKind::seam, 3},
                                                                             {VertexKind::corner, 2}}));
    EXPECT_EQ(kinds_of(shapes::fin(4))[VertexKind::complex], 5);
    EXPECT_EQ(kinds_of(shapes::sphere({.segments = 24, .rings = 12, .materials = 3})),
              (Kinds{{VertexKind::manifold, 231}, {VertexKind::seam, 33}, {VertexKind::corner, 2}}));
    EXPECT_EQ(kinds_of(shapes::faceted_sphere()), (Kinds{{VertexKind::manifold, 266}}))
        << "normals and colours are no seams";
}

// The triangles that the rule names once more, with a material of their own.
template <typename Rule>
Mesh with_decal(Mesh mesh, Rule covers) {
    const auto slot = static_cast<uint32_t>(mesh.slots.size());
    mesh.slots.push_back({});
    const size_t count = mesh.triangle_count();
    for (size_t t = 0; t < count; ++t) {
        if (!covers(t)) continue;
        for (size_t k = 0; k < 3; ++k) mesh.triangles.push_back(mesh.triangles[3 * t + k]);
        mesh.triangle_slot.push_back(slot);
    }
    return mesh;
}

TEST(VertexKinds, see_one_surface_where_triangles_lie_on_each_other) {
    const Mesh cylinder = shapes::cylinder({.segments = 8, .rows = 4});
    const Mesh covered = with_decal(cylinder, [](size_t) { return true; });
    EXPECT_EQ(kinds_of(covered), kinds_of(cylinder));
    const Mesh half = with_decal(shapes::sphere({.segments = 8, .rings = 8}),
                                 [](size_t t) { return t < 8 + 3 * 16; });  // down to the equator
    EXPECT_EQ(kinds_of(half)[VertexKind::seam], 8) << "the decal ends along a line";
    EXPECT_EQ(kinds_of(half)[VertexKind::complex], 0);
}

TEST(UvGuard, lets_no_triangle_turn_over_in_the_texture_alone) {
    // A flat strip whose texture is mirrored at its middle, as u = |x|: a collapse across the middle would
    // lay what is on one side over the other.
    Mesh strip = shapes::grid({.columns = 8, .rows = 1, .uvs = true});
    std::vector<float>& uv = strip.attributes[0].values;
    for (size_t w = 0; w < strip.wedge_count(); ++w) {
        uv[2 * w] = std::abs(strip.positions[strip.wedge_vertex[w]].x - 0.5F);
    }
    const auto vertex_at = [&](float x) {
        const auto found = std::find_if(strip.positions.begin(), strip.positions.end(),
                                        [&](Vec3f p) { return p.x == x && p.z == 0; });
        return static_cast<uint32_t>(found - strip.positions.begin());
    };
    const CollapseMesh collapsing(strip);
    const UvGuard guard(collapsing, strip, {});
    const auto may_collapse = [&](uint32_t removed, uint32_t kept) {
        return guard.may_collapse(removed, kept, {collapsing.wedge_begin(kept)});
    };
    EXPECT_FALSE(may_collapse(vertex_at(0.5F), vertex_at(0.625F))) << "off the axis";
    EXPECT_FALSE(may_collapse(vertex_at(0.5F), vertex_at(0.375F))) << "off the axis";
    EXPECT_TRUE(may_collapse(vertex_at(0.25F), vertex_at(0.375F))) << "on one side";
}

TEST(InstanceMetric, is_the_identity_where_instances_are_only_turned_moved_scaled_and_mirrored) {
    const std::vector<Transform> instances = {from_trs({1, 2, 3}, {0.1, 0.2, 0.3, 0.9}, {2, 2, 2}),
                                              from_trs({}, {0, 0, 0, 1}, {-0.01, 0.01, 0.01})};
    const InstanceMetric metric(instances);
    for (const Vec3d n : {Vec3d{1, 0, 0}, {0, 1, 0}, {0.6, 0, 0.8}}) EXPECT_EQ(metric.shrink(n), 1);
    EXPECT_EQ(InstanceMetric({}).shrink({1, 0, 0}), 1);
}

TEST(InstanceMetric, shrinks_a_normal_as_the_instance_does_at_equal_volume) {
    const Transform stretched = from_trs({5, 6, 7}, {0, 0, 0, 1}, {8, 1, 1});
    const InstanceMetric metric(std::vector{stretched});
    EXPECT_NEAR(metric.shrink({1, 0, 0}), 2.0 / 8, 1e-5);  // 2: the cube root of the volume
    EXPECT_NEAR(metric.shrink({0, 1, 0}), 2.0 / 1, 1e-5);
}

TEST(InstanceMetric, measures_like_the_instance_at_equal_volume) {
    const Transform sheared = {{2, 1, 0, 5, 0, 0.5, 0, 6, 0, 0.25, 1, 7}};  // determinant 1
    const InstanceMetric metric(std::vector{sheared});
    const Vec3d d = {1, 2, 3}, e = {-2, 0.5, 1};
    EXPECT_NEAR(dot(metric.dual(d), e), dot(sheared.direction(d), sheared.direction(e)), 1e-4);
    EXPECT_EQ(InstanceMetric({}).dual(d), d);
}

TEST(UnifiedError, is_that_of_the_stretched_mesh_where_its_instances_are_stretched) {
    const Transform stretch = {{4, 0.5, 0, 0, 0, 0.5, 0, 0, 0, 0, 0.5, 0}};  // determinant 1
    const Mesh hills = shapes::grid({.columns = 6, .rows = 6, .height = 0.3});
    Mesh stretched = hills;
    transform_mesh(stretch, stretched);
    const auto costs = [](const Mesh& mesh, const std::vector<Transform>& instances) {
        const CollapseMesh collapsing(mesh);
        AttributeClouds clouds(collapsing, mesh, {});
        const Features features = find_features(collapsing, {});
        Projection projection(collapsing);
        const CollapseParts parts = {collapsing, features.edges, clouds, projection};
        const UnifiedError errors(parts, {.instances = instances}, {});
        std::vector<double> all;
        for (uint32_t corner = 0; corner < 3 * collapsing.triangle_count(); ++corner) {
            const uint32_t removed = collapsing.corner_vertex(corner);
            const uint32_t kept = collapsing.corner_vertex(CollapseMesh::next_corner(corner));
            all.push_back(errors.cost(removed, kept, {collapsing.wedge_begin(kept)}).geometric);
        }
        return all;
    };
    const std::vector<double> in_mesh = costs(hills, {stretch}), in_world = costs(stretched, {});
    // Apart from what tells edges of flat ground apart, a thousandth of their length in the mesh.
    for (size_t i = 0; i < in_world.size(); ++i)
        EXPECT_NEAR(in_mesh[i], in_world[i], 0.01 * in_world[i] + 1e-4) << "edge " << i;
}

TEST(InstanceMetric, takes_instances_that_are_flat_or_no_numbers) {
    const Transform flat = from_trs({}, {0, 0, 0, 1}, {1, 1, 0}), nothing = from_trs({}, {0, 0, 0, 1}, {});
    EXPECT_TRUE(std::isfinite(InstanceMetric(std::vector{flat}).shrink({0, 0, 1})));
    EXPECT_EQ(InstanceMetric(std::vector{nothing}).shrink({0, 0, 1}), 1);
    Transform broken;
    broken.m[0] = std::nan("");
    EXPECT_EQ(InstanceMetric(std::vector{broken}).shrink({0, 0, 1}), 1);
}

TEST(CollapseRules, refuse_what_would_make_a_tetrahedron_flat) {
    const Mesh mesh = shapes::tetrahedron();
    const CollapseMesh collapsing(mesh);
    CollapseRules rules(collapsing, find_features(collapsing, {}).kinds);
    for (uint32_t kept = 1; kept < 4; ++kept) EXPECT_EQ(rules.check(0, kept), Refusal::topology);
}

TEST(CollapseRules, refuse_to_fold_a_triangle_over) {
    // An arrow head and a vertex in it. Moved to the tip it leaves all triangles facing up; moved to a wing,
    // the triangle at the notch turns over.
    Mesh arrow;
    arrow.positions = {{1.5F, 0, 0}, {3, 0, 0}, {0, 2, 0}, {0.8F, 0, 0}, {0, -2, 0}};
    arrow.wedge_vertex = {0, 1, 2, 3, 4};
    arrow.triangles = {0, 1, 2, 0, 2, 3, 0, 3, 4, 0, 4, 1};
    arrow.triangle_slot = {0, 0, 0, 0};
    arrow.slots.push_back({});
    const CollapseMesh collapsing(arrow);
    CollapseRules rules(collapsing, find_features(collapsing, {}).kinds);
    EXPECT_EQ(rules.check(0, 1), Refusal::none);
    EXPECT_EQ(rules.check(0, 3), Refusal::none);
    EXPECT_EQ(rules.check(0, 2), Refusal::topology);
    EXPECT_EQ(rules.check(0, 4), Refusal::topology);
}

// Two fans back to back: `slices` around, their hubs first.
Mesh bipyramid(uint32_t slices) {
    Mesh mesh;
    mesh.slots.push_back({});
    mesh.positions = {{0, 0.5F, 0}, {0, -0.5F, 0}};
    for (uint32_t i = 0; i < slices; ++i) {
        const double angle = 2 * 3.14159265358979 * i / slices;
        mesh.positions.push_back(to_float({std::sin(angle), 0, std::cos(angle)}));
        const uint32_t here = 2 + i, next = 2 + (i + 1) % slices;
        mesh.triangles.insert(mesh.triangles.end(), {0, here, next, 1, next, here});
        mesh.triangle_slot.insert(mesh.triangle_slot.end(), 2, 0);
    }
    for (uint32_t v = 0; v < mesh.vertex_count(); ++v) mesh.wedge_vertex.push_back(v);
    return mesh;
}

// Gives a vertex that many triangles more, which have only that vertex in common with the rest.
void add_fan(Mesh& mesh, uint32_t hub, uint32_t slices) {
    for (uint32_t i = 0; i <= slices; ++i) {
        const auto v = static_cast<uint32_t>(mesh.positions.size());
        mesh.positions.push_back({float(i), 1, 1});
        mesh.wedge_vertex.push_back(v);
        if (i == 0) continue;
        mesh.triangles.insert(mesh.triangles.end(), {hub, v - 1, v});
        mesh.triangle_slot.push_back(0);
    }
}

TEST(CollapseRules, search_the_shorter_ring_of_two) {
    Mesh mesh = bipyramid(100);
    add_fan(mesh, 1, 100);
    const CollapseMesh collapsing(mesh);
    CollapseRules rules(collapsing, find_features(collapsing, {}).kinds);
    EXPECT_TRUE(rules.keeps_topology(2, 0)) << "1 has too many triangles to search, 0 has not";
}

TEST(CollapseRules, search_the_shortest_ring_of_three) {
    for (const bool has_bottom : {false, true}) {  // of the tetrahedron over 0, 1 and 2
        Mesh mesh;
        mesh.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0.2F, 0.2F, 0.2F}};
        mesh.wedge_vertex = {0, 1, 2, 3};
        mesh.triangles = {0, 1, 3, 1, 2, 3, 2, 0, 3};
        mesh.triangle_slot = {0, 0, 0};
        mesh.slots.push_back({});
        if (has_bottom) {
            mesh.triangles.insert(mesh.triangles.end(), {0, 2, 1});
            mesh.triangle_slot.push_back(0);
        }
        add_fan(mesh, 1, 200);
        add_fan(mesh, 2, 200);
        const CollapseMesh collapsing(mesh);
        CollapseRules rules(collapsing, find_features(collapsing, {}).kinds);
        EXPECT_EQ(rules.keeps_topology(3, 0), !has_bottom);
    }
}

TEST(CollapseRules, search_no_hub_for_another_hub) {
    constexpr uint32_t slices = 5000;
    const Mesh mesh = bipyramid(slices);
    const CollapseMesh collapsing(mesh);
    CollapseRules rules(collapsing, find_features(collapsing, {}).kinds);
    for (uint32_t removed = 2; removed < 2 + slices; ++removed) {
        EXPECT_EQ(rules.check(removed, 0), Refusal::topology) << "not known, and too long to find out";
    }
    EXPECT_LT(rules.searched(), 20 * slices);
}

TEST(Features, are_found_with_looks_at_the_stop_amid_a_vertex_of_very_many_triangles) {
    const CollapseMesh collapsing(bipyramid(4 * watched_stride));
    size_t checks = 0;
    find_features(collapsing, {.checked = [&checks] { ++checks; }});
    EXPECT_GE(checks, 2U * 3U * 4U) << "two hubs, whose triangles are looked at three times, in four strides";
}

// Vertex 0 lies on the edge from 1 to 2, in a triangle without area; 3 is on one side of it, 4 on the other.
Mesh flat_triangle(bool wound_like_the_rest) {
    Mesh mesh;
    mesh.positions = {{1, 0, 0}, {0, 0, 0}, {2, 0, 0}, {1, 1, 0}, {1, -1, 0}};
    mesh.wedge_vertex = {0, 1, 2, 3, 4};
    mesh.triangles = {1, 0, 3, 0, 2, 3, 2, 1, 4, 0, 1, 2};
    if (!wound_like_the_rest) std::swap(mesh.triangles[10], mesh.triangles[11]);
    mesh.triangle_slot = {0, 0, 0, 0};
    mesh.slots.push_back({});
    return mesh;
}

TEST(CollapseRules, let_a_triangle_without_area_open_to_where_the_surface_faces_alone) {
    for (const bool wound_like_the_rest : {true, false}) {
        const Mesh mesh = flat_triangle(wound_like_the_rest);
        const CollapseMesh collapsing(mesh);
        CollapseRules rules(collapsing, find_features(collapsing, {}).kinds);
        EXPECT_EQ(rules.check(0, 3), wound_like_the_rest ? Refusal::none : Refusal::topology);
    }
}

TEST(BoundsGuard, keeps_the_last_vertex_of_each_side) {
    const Mesh mesh = shapes::tetrahedron();
    const CollapseMesh collapsing(mesh);
    BoundsGuard guard(collapsing, 0.01);
    for (uint32_t v = 1; v < 4; ++v) EXPECT_FALSE(guard.may_remove(v));
    BoundsGuard loose(collapsing, 2.0);
    EXPECT_TRUE(loose.may_remove(1));
    for (uint32_t v = 1; v < 4; ++v) loose.remove(v);
    EXPECT_FALSE(loose.may_remove(0));
}

}  // namespace
}  // namespace coppice
