#include "bench/papers/scene_runs.h"

#include <string>
#include <vector>

#include "bench/papers/measure.h"
#include "core/optimize/optimize.h"

namespace coppice::papers {
namespace {

SceneRun run_once(const Upload& scene, const OptimizeOptions& options) {
    SceneRun run;
    const double start = cpu_now_ms();
    double stage_start = start;
    std::string running;
    Watch watch;
    watch.stage = [&](std::string_view stage) {
        const double now = cpu_now_ms();
        if (running == "simplify") run.simplify_ms = now - stage_start;
        running = stage;
        stage_start = now;
    };
    run.report = optimize(scene, options, {}, watch).report;
    run.total_ms = cpu_now_ms() - start;
    return run;
}

SceneRun median_of(const std::vector<SceneRun>& all) {
    std::vector<double> simplify, total;
    for (const SceneRun& run : all) {
        simplify.push_back(run.simplify_ms);
        total.push_back(run.total_ms);
    }
    return {all.front().report, median(simplify), median(total)};
}

}  // namespace

SceneRuns run_scene(const Upload& scene, double removed) {
    std::array<std::vector<SceneRun>, count_contenders> all;
    for (int run = 0; run < runs; ++run) {
        for (size_t c = 0; c < count_contenders; ++c) {
            OptimizeOptions options = {.algorithm = contender_names[c], .ratio = 1 - removed, .threads = 1};
            if (c == quadric || c == gaps) options.parameters = {{"instances", "expand"}};
            all[c].push_back(run_once(scene, options));
        }
    }
    SceneRuns result;
    for (size_t c = 0; c < count_contenders; ++c) result[c] = median_of(all[c]);
    return result;
}

}  // namespace coppice::papers
