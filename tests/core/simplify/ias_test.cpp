#include "core/simplify/ias.h"

#include <gtest/gtest.h>

#include "tests/support/shapes.h"

namespace coppice {
namespace {

std::vector<Transform> copies(size_t count, double scale = 1) {
    return std::vector<Transform>(count, from_trs({}, {0, 0, 0, 1}, {scale, scale, scale}));
}

std::vector<Simplified> simplify(const std::vector<Mesh>& meshes,
                                 const std::vector<std::vector<Transform>>& instances, uint64_t triangles,
                                 bool rendered = true) {
    const SceneTarget target = {
        .triangles = triangles, .rendered = rendered, .of_mesh = std::vector<Target>(meshes.size())};
    const auto values = ParameterValues::parse(ias().parameters, {});
    return ias().simplify_scene(meshes, instances, target, values, {}).meshes;
}

const Mesh& ball() {
    static const Mesh mesh = shapes::sphere({.segments = 32, .rings = 16, .normals = false});
    return mesh;
}

TEST(Ias, keeps_more_of_what_stands_larger) {
    const auto results = simplify({ball(), ball()}, {copies(1), copies(1, 3)}, ball().triangle_count());
    EXPECT_LT(results[0].mesh.triangle_count(), results[1].mesh.triangle_count());
}

TEST(Ias, keeps_more_of_what_stands_often_for_a_target_in_stored_triangles) {
    const auto results = simplify({ball(), ball()}, {copies(1), copies(50)}, ball().triangle_count(), false);
    EXPECT_LT(results[0].mesh.triangle_count(), results[1].mesh.triangle_count());
}

TEST(Ias, counts_triangles_as_often_as_they_are_drawn) {
    const size_t whole = ball().triangle_count();
    const auto results = simplify({ball(), ball()}, {copies(10), copies(2)}, 6 * whole);
    const size_t drawn = 10 * results[0].mesh.triangle_count() + 2 * results[1].mesh.triangle_count();
    EXPECT_LE(drawn, 6 * whole);
    EXPECT_GT(drawn, 6 * whole - 20);
    for (const Simplified& s : results) EXPECT_EQ(s.stop_reason, StopReason::target);
}

TEST(Ias, does_the_same_to_one_mesh_however_many_similar_instances_it_has) {
    const size_t whole = ball().triangle_count();
    const auto one = simplify({ball()}, {copies(1)}, whole / 2);
    const auto many = simplify({ball()}, {copies(1000, 2)}, 1000 * whole / 2);
    EXPECT_EQ(one[0].mesh.triangles, many[0].mesh.triangles);
    EXPECT_EQ(one[0].mesh.positions, many[0].mesh.positions);
}

TEST(Ias, leaves_alone_what_is_not_drawn) {
    const auto results = simplify({ball(), ball()}, {copies(1), {}}, 100);
    EXPECT_EQ(results[1].mesh.triangle_count(), ball().triangle_count());
    EXPECT_EQ(results[1].stop_reason, StopReason::already_smaller);
}

TEST(Ias, says_why_it_stopped_short) {
    const auto results = simplify({shapes::tetrahedron()}, {copies(1)}, 1);
    EXPECT_EQ(results[0].mesh.triangle_count(), 4U);
    EXPECT_EQ(results[0].stop_reason, StopReason::bounds);
}

}  // namespace
}  // namespace coppice
