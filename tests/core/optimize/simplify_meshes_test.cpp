#include "core/optimize/simplify_meshes.h"

#include <gmock/gmock.h>

#include <atomic>

#include "core/base/error.h"
#include "core/sample/sample.h"
#include "core/simplify/registry.h"

namespace coppice {
namespace {

std::vector<Simplified> run(const Scene& scene, unsigned threads, const Watch& watch = {}) {
    const Algorithm& algorithm = default_algorithm();
    const auto parameters = ParameterValues::parse(algorithm.parameters, {});
    const Placement placement = place(scene);
    const auto targets = plan_targets(scene, placement, algorithm, parameters, {});
    return simplify_meshes(scene.meshes, placement, targets, algorithm, parameters, threads, watch);
}

TEST(SimplifyMeshes, gives_the_same_meshes_for_any_number_of_threads) {
    const Scene scene = make_sample("baked", {.scale = 0.3});
    const auto one = run(scene, 1);
    for (const unsigned threads : {2U, 7U}) {
        const auto many = run(scene, threads);
        for (size_t i = 0; i < one.size(); ++i) {
            EXPECT_EQ(one[i].mesh.positions, many[i].mesh.positions);
            EXPECT_EQ(one[i].mesh.triangles, many[i].mesh.triangles);
            EXPECT_EQ(one[i].error_model_units, many[i].error_model_units);
        }
    }
}

TEST(SimplifyMeshes, tells_a_progress_that_never_goes_back_and_ends_at_one) {
    const Scene scene = make_sample("baked", {.scale = 0.3});
    std::vector<double> told;
    run(scene, 4, {.progress = [&](double fraction) { told.push_back(fraction); }});
    ASSERT_GT(told.size(), 5U);
    EXPECT_TRUE(std::is_sorted(told.begin(), told.end()));
    EXPECT_EQ(told.back(), 1);
}

// What bounds the time from a stop to its end, in counts that no other load changes.
TEST(SimplifyMeshes, looks_at_the_stop_once_in_few_collapses) {
    const Scene scene = make_sample("bunny13", {.triangles = 20'000});
    const auto triangles = scene.meshes[0].triangle_count();
    size_t checks = 0;
    run(scene, 1, {.checked = [&checks] { ++checks; }});
    const size_t collapses = triangles / 4;  // each takes two triangles, half of them go
    EXPECT_GT(checks, collapses / 16);
}

TEST(SimplifyMeshes, each_thread_looks_no_second_time_after_a_stop) {
    const Scene scene = make_sample("baked", {.scale = 0.3});
    std::stop_source source;
    std::atomic<size_t> looks = 0;
    const Watch watch = {.stop = source.get_token(), .checked = [&] {
                             if (++looks == 500) source.request_stop();
                         }};
    EXPECT_THROW(run(scene, 2, watch), Error);
    EXPECT_LE(looks, 500U + 2U);
}

TEST(SimplifyMeshes, starts_nothing_once_stopped) {
    std::stop_source source;
    source.request_stop();
    EXPECT_THROW(run(make_sample("cad", {.scale = 0.1}), 2, {.stop = source.get_token()}), Error);
}

TEST(SimplifyMeshes, leaves_points_and_lines_alone) {
    Scene scene = make_sample("cad", {.scale = 0.1});
    scene.meshes[0].triangles.clear();
    scene.meshes[0].triangle_slot.clear();
    const auto results = run(scene, 1);
    EXPECT_EQ(results[0].stop_reason, StopReason::already_smaller);
    EXPECT_EQ(results[0].mesh.positions, scene.meshes[0].positions);
}

}  // namespace
}  // namespace coppice
