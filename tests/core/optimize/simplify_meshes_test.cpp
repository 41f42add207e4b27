#include "core/optimize/simplify_meshes.h"

#include <gmock/gmock.h>

#include <stop_token>

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

// How many milliseconds that is, depends on the machine: a step of the work does not.
TEST(SimplifyMeshes, stops_at_the_next_of_many_steps_once_asked_to) {
    const Scene scene = make_sample("bunny13", {.triangles = 100'000});
    std::stop_source source;
    std::vector<double> told;
    Watch watch = {.stop = source.get_token()};
    watch.progress = [&](double fraction) {
        told.push_back(fraction);
        if (told.size() == 10) source.request_stop();
    };
    try {
        run(scene, 2, watch);
        FAIL() << "was not stopped";
    } catch (const Error& error) {
        EXPECT_EQ(error.code(), ErrorCode::job_cancelled);
    }
    EXPECT_EQ(told.size(), 10U);
    EXPECT_LT(told.back(), 0.3);
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
