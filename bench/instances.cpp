// The claim of the ITS paper: simplifying a scene of N instances costs what one mesh costs. Times the
// simplify stage of whole optimizations (bytes to bytes) of one mesh with 1 to 10000 instances and prints a
// table.
//
//   build/release/bench/bench_instances
#include <fmt/core.h>

#include <algorithm>
#include <vector>

#include "bench/median.h"
#include "core/optimize/optimize.h"
#include "core/sample/sample.h"

namespace coppice {
namespace {

struct Scenario {
    uint32_t instances = 1;
    Bytes bytes = {};
    std::vector<double> discover = {}, simplify = {}, total = {};  // milliseconds of each run

    void run() {
        const Upload upload = {.asset = {.path = "bench.glb", .bytes = bytes}};
        const Report report = optimize(upload, {.ratio = 0.5, .threads = 1}, {}, {}).report;
        discover.push_back(report.timing_ms.discover);
        simplify.push_back(report.timing_ms.simplify);
        total.push_back(report.timing_ms.total);
    }
};

}  // namespace
}  // namespace coppice

int main() {
    using namespace coppice;
    constexpr int runs = 11;
    std::vector<Scenario> scenarios;
    for (const uint32_t count : {1U, 10U, 100U, 1000U, 10'000U}) {
        const Scene scene = make_sample("bunny13", {.copies = count});
        scenarios.push_back({.instances = count, .bytes = write_asset(scene, {}, {}).bytes});
    }
    for (Scenario& scenario : scenarios) scenario.run();  // warm up
    for (Scenario& scenario : scenarios) scenario.discover = scenario.simplify = scenario.total = {};
    // In turns, so that whatever else the machine does falls on all alike.
    for (int i = 0; i < runs; ++i) {
        for (Scenario& scenario : scenarios) scenario.run();
    }
    fmt::print(
        "One mesh of 2,503 vertices and 4,968 triangles, ratio 0.5, one thread, medians of {} runs.\n\n",
        runs);
    fmt::print(
        "| instances | file, KB | simplify, ms | to N = 1 | discover, ms | total, ms "
        "|\n|---:|---:|---:|---:|---:|---:|\n");
    const double one = median(scenarios.front().simplify);
    for (const Scenario& scenario : scenarios) {
        const double simplify = median(scenario.simplify);
        fmt::print("| {} | {} | {:.1f} | {:.2f} | {:.1f} | {:.1f} |\n", scenario.instances,
                   scenario.bytes.size() / 1000, simplify, simplify / one, median(scenario.discover),
                   median(scenario.total));
    }
    return 0;
}
