#include "core/compare/compare_scenes.h"

#include <gmock/gmock.h>

#include "core/base/error.h"
#include "core/compare/correspondence.h"
#include "core/scene/expand.h"
#include "tests/core/compare/meshes.h"
#include "tests/support/shapes.h"

namespace coppice {
namespace {

using test::moved, test::scene_of, test::shift, test::scaling;

constexpr uint64_t plenty = 1'000'000;

SceneComparison compare(const Scene& reference, const Scene& candidate, const CompareOptions& options = {}) {
    return compare_scenes(reference, candidate, options, plenty, {});
}

Error refusal(const Scene& reference, const Scene& candidate, uint64_t limit = plenty) {
    try {
        compare_scenes(reference, candidate, {}, limit, {});
    } catch (const Error& error) {
        return error;
    }
    return {ErrorCode::internal, "", "nothing was refused"};
}

// Far from each other, so that no instance is nearer to another one than to itself.
Scene forest(const Mesh& tree, const Mesh& stone) {
    return scene_of({tree, stone}, {{0, shift(0, 0, 0)},
                                    {1, shift(20, 0, 0)},
                                    {0, shift(40, 0, 0) * scaling(3, 3, 3)},
                                    {0, shift(60, 0, 0) * scaling(-2, 2, 2)},
                                    {1, shift(80, 0, 0) * from_trs({}, {0, 0.6, 0, 0.8}, {0.5, 0.5, 0.5})}});
}

Scene reference_forest() {
    return forest(shapes::sphere({.segments = 48, .rings = 24}), shapes::box());
}

Scene candidate_forest() {
    return forest(shapes::sphere(), moved(shapes::box(), shift(0.01, 0, 0)));
}

void expect_near(const Spread& a, const Spread& b, double relative) {
    EXPECT_NEAR(a.largest, b.largest, relative * b.largest);
    EXPECT_NEAR(a.mean, b.mean, relative * b.mean);
    EXPECT_NEAR(a.root_mean_square, b.root_mean_square, relative * b.root_mean_square);
}

TEST(CompareScenes, measures_each_mesh_once_and_finds_what_measuring_every_instance_finds) {
    const SceneComparison by_mesh = compare(reference_forest(), candidate_forest(), {.samples = 50});
    EXPECT_TRUE(by_mesh.is_by_mesh);
    ASSERT_EQ(by_mesh.meshes.size(), 2);
    EXPECT_EQ(by_mesh.meshes[0].instances, 3);
    EXPECT_NEAR(by_mesh.meshes[0].largest_scale, 3, 1e-12);

    const SceneComparison expanded =
        compare(bake_instances(reference_forest()), candidate_forest(), {.samples = 50});
    EXPECT_FALSE(expanded.is_by_mesh);
    EXPECT_THAT(expanded.meshes, testing::IsEmpty());
    expect_near(by_mesh.surface.symmetric, expanded.surface.symmetric, 0.02);
    expect_near(by_mesh.surface.reference_to_candidate, expanded.surface.reference_to_candidate, 0.02);
    EXPECT_NEAR(by_mesh.surface.normals->mean, expanded.surface.normals->mean,
                0.02 * expanded.surface.normals->mean);
    EXPECT_NEAR(by_mesh.surface.normals->percentile_95, expanded.surface.normals->percentile_95, 0.15);
    EXPECT_EQ(expanded.surface.flips.triangles, 0);  // the mirrored instance keeps its outside
    EXPECT_NEAR(by_mesh.diagonal, expanded.diagonal, 1e-5 * expanded.diagonal);
}

TEST(CompareScenes, weighs_lengths_with_the_largest_scale_and_areas) {
    // A plane that is 0.1 off, at scales 1 and 3: a tenth and three tenths, the latter on nine times the
    // area.
    const Mesh plane = shapes::grid(), off = moved(plane, shift(0, 0.1, 0));
    const auto twice = [](const Mesh& mesh) {
        return scene_of({mesh}, {{0, {}}, {0, shift(20, 0, 0) * scaling(3, 3, 3)}});
    };
    const Spread found = compare(twice(plane), twice(off)).surface.symmetric;
    EXPECT_NEAR(found.largest, 0.3, 1e-6);
    EXPECT_NEAR(found.mean, 0.28, 1e-6);
    EXPECT_NEAR(found.root_mean_square, std::sqrt((0.01 + 9 * 0.09) / 10), 1e-6);
}

TEST(CompareScenes, is_on_the_safe_side_where_the_scale_is_not_uniform) {
    const auto stretched = [](const Mesh& mesh) { return scene_of({mesh}, {{0, scaling(1, 1, 5)}}); };
    const Scene a = stretched(shapes::sphere({.segments = 48, .rings = 24})), b = stretched(shapes::sphere());
    const SceneComparison by_mesh = compare(a, b), expanded = compare(bake_instances(a), b);
    EXPECT_TRUE(by_mesh.is_by_mesh);
    EXPECT_GE(by_mesh.surface.symmetric.largest, expanded.surface.symmetric.largest);
    EXPECT_GE(by_mesh.surface.symmetric.mean, expanded.surface.symmetric.mean);
}

TEST(CompareScenes, of_ten_thousand_instances_are_those_of_one) {
    const auto many = [](const Mesh& mesh, int count) {
        std::vector<std::pair<uint32_t, Transform>> placed;
        for (int i = 0; i < count; ++i) placed.emplace_back(0, shift(3.0 * i, 0, 0));
        return scene_of({mesh}, placed);
    };
    const Mesh fine = shapes::sphere({.segments = 48, .rings = 24}), rough = shapes::sphere();
    // As one surface they would be over the limit by far.
    const Spread found = compare(many(fine, 10'000), many(rough, 10'000)).surface.symmetric;
    const Spread one = compare(many(fine, 1), many(rough, 1)).surface.symmetric;
    EXPECT_EQ(found.largest, one.largest);
    EXPECT_NEAR(found.mean, one.mean, 1e-9);
}

TEST(CompareScenes, expands_where_a_mesh_has_vanished) {
    Scene vanished = candidate_forest();
    vanished.meshes[1].triangles.clear();
    vanished.meshes[1].triangle_slot.clear();
    const SceneComparison found = compare(reference_forest(), vanished);
    EXPECT_FALSE(found.is_by_mesh);
    EXPECT_GT(found.surface.reference_to_candidate.largest, 15);  // the nearest thing to a stone is a tree
    EXPECT_LT(found.surface.candidate_to_reference.largest, 1);
}

TEST(CompareScenes, expands_where_instances_moved_and_finds_by_how_much) {
    const Scene here = scene_of({shapes::grid()}, {{0, {}}}),
                there = scene_of({shapes::grid()}, {{0, shift(0, 0.5, 0)}});
    const SceneComparison found = compare(here, there);
    EXPECT_FALSE(found.is_by_mesh);
    EXPECT_NEAR(found.surface.symmetric.mean, 0.5, 1e-9);
}

TEST(CompareScenes, refuses_what_is_too_large_expanded_and_says_why) {
    const Scene a = scene_of({shapes::grid()}, {{0, {}}, {0, shift(2, 0, 0)}}),
                b = scene_of({shapes::grid()}, {{0, {}}});
    const Error error = refusal(a, b, 600);
    EXPECT_EQ(error.code(), ErrorCode::asset_too_large);
    EXPECT_THAT(
        error.message(),
        testing::HasSubstr("the reference has 1024 triangles with every instance, and the limit is 600"));
}

TEST(CompareScenes, refuses_scenes_without_a_triangle) {
    const Scene something = scene_of({shapes::grid()}, {{0, {}}});
    const Scene nothing = scene_of({test::mesh_of({{0, 0, 0}}, {})}, {{0, {}}});
    const Scene unplaced = scene_of({shapes::grid()}, {});
    EXPECT_EQ(refusal(nothing, something).code(), ErrorCode::asset_no_surface);
    EXPECT_THAT(refusal(something, nothing).message(), testing::HasSubstr("the candidate draws no triangle"));
    EXPECT_EQ(refusal(something, unplaced).code(), ErrorCode::asset_no_surface);
}

TEST(CompareScenes, refuses_coordinates_whose_squares_are_no_numbers) {
    const Scene a = scene_of({shapes::grid()}, {{0, scaling(1e80, 1e80, 1e80)}}),
                b = scene_of({shapes::grid()}, {{0, {}}});
    EXPECT_EQ(refusal(b, a).code(), ErrorCode::asset_malformed);
}

TEST(CompareScenes, counts_elements_of_both) {
    Scene broken = candidate_forest();
    test::append(broken.meshes[1],
                 test::mesh_of({{-1, 0.2F, 0.2F}, {2, 0.3F, 0.3F}, {2, 0.4F, 0.3F}}, {0, 1, 2}));
    broken.meshes[1].attributes.clear();
    const SceneComparison found = compare(reference_forest(), broken, {.self_intersections = true});
    EXPECT_EQ(found.reference.elements.border_edges, 0);
    EXPECT_EQ(found.candidate.elements.border_edges, 3);
    EXPECT_EQ(found.candidate.elements.components, 3);
    EXPECT_EQ(found.reference.self_intersections->pairs, 0);
    EXPECT_GE(found.candidate.self_intersections->pairs, 2);
    EXPECT_FALSE(compare(reference_forest(), broken).reference.self_intersections.has_value());
}

TEST(CompareScenes, is_the_same_to_the_bit_for_any_number_of_threads) {
    const SceneComparison one = compare(reference_forest(), candidate_forest(), {.threads = 1});
    const SceneComparison four = compare(reference_forest(), candidate_forest(), {.threads = 4});
    EXPECT_EQ(one.surface.symmetric.mean, four.surface.symmetric.mean);
    EXPECT_EQ(one.surface.symmetric.root_mean_square, four.surface.symmetric.root_mean_square);
    EXPECT_EQ(one.surface.normals->mean, four.surface.normals->mean);
    EXPECT_EQ(one.meshes[1].surface.symmetric.mean, four.meshes[1].surface.symmetric.mean);
}

TEST(CompareScenes, tells_progress_that_never_goes_back_and_stops_anywhere) {
    size_t told = 0;
    double last = 0;
    Watch watch;
    watch.progress = [&](double fraction) {
        ++told;
        EXPECT_GE(fraction, last);
        last = fraction;
    };
    compare_scenes(reference_forest(), candidate_forest(), {.self_intersections = true}, plenty, watch);
    EXPECT_EQ(last, 1);
    ASSERT_GE(told, 6);
    for (const size_t at : {size_t{1}, told / 3, told / 2, told - 2}) {
        std::stop_source stop;
        size_t count = 0;
        Watch stopping = {.stop = stop.get_token()};
        stopping.progress = [&](double) {
            if (++count == at) stop.request_stop();
        };
        EXPECT_THROW(compare_scenes(reference_forest(), candidate_forest(), {.self_intersections = true},
                                    plenty, stopping),
                     Error);
        EXPECT_LE(count, at + 8);
    }
}

TEST(CompareOptions, take_samples_from_1_to_10000) {
    for (const double samples : {0.5, 10'001.0, std::numeric_limits<double>::quiet_NaN()}) {
        EXPECT_THROW(validate({.samples = samples}), Error) << samples;
    }
    validate({.samples = 1});
}

}  // namespace
}  // namespace coppice
