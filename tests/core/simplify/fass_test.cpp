#include "core/simplify/fass.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "core/simplify/fad.h"
#include "core/simplify/ss.h"
#include "tests/core/simplify/run_algorithm.h"
#include "tests/support/shapes.h"

namespace coppice {
namespace {

using test::run_algorithm;

const Mesh& ball() {
    static const Mesh mesh = shapes::blob({.segments = 60, .rings = 40, .uvs = false});
    return mesh;
}

// A flat sheet out of which every fourth vertex, both ways, is pulled.
Mesh with_tips() {
    Mesh mesh = shapes::grid({.columns = 24, .rows = 24});
    for (Vec3f& p : mesh.positions) {
        const long column = std::lround(p.x * 24), row = std::lround(p.z * 24);
        if (column % 4 == 2 && row % 4 == 2) p.y = 0.1F;
    }
    return mesh;
}

size_t tips(const Mesh& mesh) {
    return static_cast<size_t>(
        std::count_if(mesh.positions.begin(), mesh.positions.end(), [](Vec3f p) { return p.y == 0.1F; }));
}

// A ball that holds nothing: the first stage alone.
const test::Parameters first_stage = {{"radius", "1e-9u"}};

TEST(Fass, removes_no_sharp_tip_in_the_first_stage) {
    const Mesh mesh = with_tips();
    ASSERT_EQ(tips(mesh), 36U);
    const Mesh left = run_algorithm(fass(), mesh, {}, first_stage).mesh;
    EXPECT_LT(left.vertex_count(), mesh.vertex_count());
    EXPECT_EQ(tips(left), 36U);
}

TEST(Fass, merges_what_the_first_stage_left) {
    const auto vertices = [](const std::map<std::string, ParameterValue>& parameters) {
        return run_algorithm(fass(), ball(), {}, parameters).mesh.vertex_count();
    };
    EXPECT_LT(vertices({{"radius", 1.0}}), vertices(first_stage));
    EXPECT_LT(vertices({{"radius", 1.5}}), vertices({{"radius", 1.0}}));
    EXPECT_LT(vertices({}), vertices(first_stage));  // has a radius where there is no target
}

TEST(Fass, is_a_round_of_fad_then_ss) {
    const AngleOptions round = {.angle = default_angle, .all_pairs = true, .lines = true, .rounds = 1};
    const Mesh first = remove_by_angle(ball(), {}, round, {}).mesh;
    const Mesh second = run_algorithm(ss(), first, {}, {{"radius", "0.1u"}}).mesh;
    const Mesh both = run_algorithm(fass(), ball(), {}, {{"radius", "0.1u"}}).mesh;
    EXPECT_EQ(both.positions, second.positions);
    EXPECT_EQ(both.triangles, second.triangles);
    EXPECT_LT(second.vertex_count(), first.vertex_count());
    EXPECT_LT(first.vertex_count(), ball().vertex_count());
}

TEST(Fass, needs_no_second_stage_where_the_first_is_enough) {
    const Target target = {.triangles = ball().triangle_count() * 19 / 20};
    const Simplified both = run_algorithm(fass(), ball(), target),
                     first = run_algorithm(fad(), ball(), target);
    EXPECT_EQ(both.stop_reason, StopReason::target);
    EXPECT_EQ(both.mesh.triangles, first.mesh.triangles);
}

TEST(Fass, meets_small_targets_by_search) {
    const Simplified s = run_algorithm(fass(), ball(), {.triangles = ball().triangle_count() / 20});
    EXPECT_EQ(s.stop_reason, StopReason::target);
    EXPECT_GT(*s.threshold_used, 0);
}

TEST(Fass, shares_an_error_between_its_stages) {
    const Simplified s = run_algorithm(fass(), ball(), {.error_model_units = 0.01});
    EXPECT_LE(s.error_model_units, 0.01);
    EXPECT_LT(s.mesh.triangle_count(), ball().triangle_count());
}

}  // namespace
}  // namespace coppice
