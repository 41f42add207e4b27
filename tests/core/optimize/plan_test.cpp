#include "core/optimize/plan.h"

#include <gmock/gmock.h>

#include <numeric>

#include "core/base/error.h"
#include "core/sample/sample.h"
#include "core/simplify/registry.h"

namespace coppice {
namespace {

using testing::ElementsAre;

std::vector<uint64_t> split(uint64_t total, std::vector<uint64_t> sizes) {
    return split_in_proportion(total, sizes);
}

TEST(SplitInProportion, sums_to_the_total) {
    const std::vector<uint64_t> sizes = {7, 100, 33, 1, 12'345, 0, 19};
    for (uint64_t total = 6; total < 12'505; total += 7) {
        const auto parts = split_in_proportion(total, sizes);
        EXPECT_EQ(std::accumulate(parts.begin(), parts.end(), uint64_t{0}), total);
        for (size_t i = 0; i < sizes.size(); ++i) EXPECT_LE(parts[i], sizes[i]);
    }
}

TEST(SplitInProportion, gives_the_larger_more) {
    EXPECT_THAT(split(50, {80, 20}), ElementsAre(40, 10));
}

TEST(SplitInProportion, breaks_ties_by_index) {
    EXPECT_THAT(split(4, {3, 3, 3}), ElementsAre(2, 1, 1));
}

TEST(SplitInProportion, leaves_no_mesh_without_a_triangle) {
    EXPECT_THAT(split(10, {1000, 3}), ElementsAre(9, 1));
}

TEST(SplitInProportion, gives_everything_where_the_total_is_larger) {
    EXPECT_THAT(split(99, {5, 6}), ElementsAre(5, 6));
}

TEST(SplitInProportion, gives_one_each_where_the_total_is_too_small) {
    EXPECT_THAT(split(1, {5, 0, 6}), ElementsAre(1, 0, 1));
}

std::vector<Target> targets_of(const Scene& scene, const OptimizeOptions& options) {
    const Algorithm& algorithm = default_algorithm();
    const auto parameters = ParameterValues::parse(algorithm.parameters, options.parameters);
    return plan_targets(scene, place(scene), algorithm, parameters, options);
}

Scene cad() {
    return make_sample("cad", {.scale = 0.1});
}

TEST(PlanTargets, halves_each_mesh_when_nothing_is_asked) {
    const Scene scene = cad();
    const auto targets = targets_of(scene, {});
    for (size_t i = 0; i < targets.size(); ++i) {
        EXPECT_NEAR(static_cast<double>(*targets[i].triangles),
                    0.5 * static_cast<double>(scene.meshes[i].triangle_count()), 0.5);
        EXPECT_FALSE(targets[i].error_model_units);
    }
}

TEST(PlanTargets, has_no_default_ratio_beside_another_target) {
    const Scene scene = cad();
    EXPECT_FALSE(targets_of(scene, {.error = 0.01})[0].triangles);
    EXPECT_FALSE(targets_of(scene, {.parameters = {{"max_geometric_error", 0.1}}})[0].triangles);
}

TEST(PlanTargets, counts_vertices_where_asked) {
    const Scene scene = make_sample("bunny13", {});
    const Target target =
        targets_of(scene, {.ratio = 0.9, .parameters = {{"stop", std::string("vertices")}}})[0];
    EXPECT_EQ(target.vertices, 2253U);
    EXPECT_FALSE(target.triangles);
}

TEST(PlanTargets, splits_an_absolute_number_over_the_meshes) {
    uint64_t sum = 0;
    for (const Target& target : targets_of(cad(), {.triangles = 123})) sum += *target.triangles;
    EXPECT_EQ(sum, 123U);
}

TEST(PlanTargets, turns_the_error_into_model_units_at_the_largest_instance) {
    Scene scene = make_sample("bunny13", {.copies = 2});
    scene.nodes[0].local = {.m = {4, 0, 0, 0, 0, 1, 0, 0, 0, 0, 2, 0}};
    scene.nodes[1].local = {};
    const double diagonal = scene_bounds(scene).diagonal();
    EXPECT_NEAR(*targets_of(scene, {.error = 0.01})[0].error_model_units, 0.01 * diagonal / 4, 1e-12);
}

TEST(PlanTargets, knows_a_scale_for_meshes_that_stand_nowhere) {
    Scene scene = make_sample("bunny13", {.copies = 1});
    scene.roots.clear();
    EXPECT_GT(*targets_of(scene, {.error = 0.01})[0].error_model_units, 0);
}

// The box of a scene skips most instances; here each is looked at.
TEST(SceneBounds, are_exact_for_instances_of_every_kind) {
    for (const char* name : {"forest", "bunny13", "cad"}) {
        const Scene scene = make_sample(name, {.scale = 0.2});
        Bounds every_point;
        for (const Instance& instance : instances(scene)) {
            for (const Vec3f& position : scene.meshes[instance.mesh].positions) {
                every_point.extend(instance.world.point(to_double(position)));
            }
        }
        const Bounds box = scene_bounds(scene);
        EXPECT_EQ(box.min, every_point.min) << name;
        EXPECT_EQ(box.max, every_point.max) << name;
    }
}

ErrorCode refused(const OptimizeOptions& options) {
    try {
        validate(options);
    } catch (const Error& error) {
        return error.code();
    }
    return ErrorCode::internal;
}

TEST(Validate, refuses_what_is_out_of_range) {
    for (const double ratio : {0.0, 1.5, -1.0, std::nan("")}) {
        EXPECT_EQ(refused({.ratio = ratio}), ErrorCode::option_invalid) << ratio;
    }
    for (const double error : {0.0, -0.1, std::nan(""), HUGE_VAL}) {
        EXPECT_EQ(refused({.error = error}), ErrorCode::option_invalid) << error;
    }
    EXPECT_EQ(refused({.triangles = 0}), ErrorCode::option_invalid);
    EXPECT_EQ(refused({.algorithm = "magic"}), ErrorCode::option_invalid);
    EXPECT_EQ(refused({.format = Format::stl}), ErrorCode::option_invalid);
    EXPECT_EQ(refused({.parameters = {{"no_such", 1.0}}}), ErrorCode::option_unknown);
}

TEST(Validate, refuses_what_excludes_each_other) {
    EXPECT_EQ(refused({.ratio = 0.5, .triangles = 10}), ErrorCode::option_conflict);
    EXPECT_EQ(refused({.triangles = 10, .parameters = {{"stop", std::string("vertices")}}}),
              ErrorCode::option_conflict);
    EXPECT_EQ(refused({.algorithm = "gaea",
                       .parameters = {{"schema", std::string("xyz")},
                                      {"xyz", std::string("5-4-3")},
                                      {"codebook_size", 94.0}}}),
              ErrorCode::option_conflict);
    EXPECT_EQ(refused({.format = Format::obj, .instancing = Instancing::nodes}), ErrorCode::option_conflict);
    EXPECT_EQ(refused({.format = Format::iobj, .instancing = Instancing::expand}),
              ErrorCode::option_conflict);
}

TEST(Validate, refuses_a_parameter_of_another_mode) {
    try {
        validate({.parameters = {{"threshold", 0.1}}});
        ADD_FAILURE() << "was taken";
    } catch (const Error& error) {
        EXPECT_EQ(error.code(), ErrorCode::option_conflict);
        EXPECT_EQ(error.where(), "parameters.threshold");
        EXPECT_EQ(error.message(),
                  "parameters.threshold belongs to parameters.mode=faithful, and the mode is full");
    }
    EXPECT_EQ(refused({.parameters = {{"mode", std::string("full")}, {"threshold", 0.1}}}),
              ErrorCode::option_conflict);
    EXPECT_NO_THROW(validate({.parameters = {{"mode", std::string("faithful")}, {"threshold", 0.1}}}));
    const std::string xyz = "xyz";
    EXPECT_EQ(refused({.algorithm = "gaea", .parameters = {{"xyz", std::string("5-4-3")}}}),
              ErrorCode::option_conflict);
    EXPECT_EQ(refused({.algorithm = "gaea", .parameters = {{"schema", xyz}, {"n", 3.0}}}),
              ErrorCode::option_conflict);
    EXPECT_NO_THROW(
        validate({.algorithm = "gaea", .parameters = {{"schema", xyz}, {"codebook_size", 94.0}}}));
    EXPECT_EQ(refused({.algorithm = "ias", .parameters = {{"seed", 3.0}}}), ErrorCode::option_conflict);
}

TEST(Validate, refuses_an_area_tolerance_without_pairs) {
    for (const ParameterValue& none : {ParameterValue(0.0), ParameterValue(std::string("0u"))}) {
        EXPECT_EQ(
            refused({.algorithm = "gaps", .parameters = {{"pair_distance", none}, {"area_tolerance", 0.2}}}),
            ErrorCode::option_conflict);
    }
    EXPECT_NO_THROW(validate({.algorithm = "gaps", .parameters = {{"area_tolerance", 0.2}}}));
    EXPECT_NO_THROW(validate({.algorithm = "gaps", .parameters = {{"pair_distance", 0.0}}}));
}

TEST(Validate, lets_prune_instances_go_with_a_target_that_it_can_meet_alone) {
    const std::map<std::string, ParameterValue> pruning = {{"prune_instances", true}, {"seed", 3.0}};
    EXPECT_NO_THROW(validate({.algorithm = "ias", .parameters = pruning}));
    EXPECT_NO_THROW(validate({.algorithm = "ias", .ratio = 0.2, .parameters = pruning}));
    EXPECT_EQ(refused({.algorithm = "ias", .triangles = 100, .parameters = pruning}),
              ErrorCode::option_conflict);
    EXPECT_EQ(refused({.algorithm = "ias", .ratio = 0.2, .error = 0.1, .parameters = pruning}),
              ErrorCode::option_conflict);
}

TEST(Validate, takes_what_is_right) {
    EXPECT_NO_THROW(validate({}));
    EXPECT_NO_THROW(
        validate({.ratio = 1, .error = 0.001, .format = Format::iobj, .instancing = Instancing::nodes}));
}

}  // namespace
}  // namespace coppice
