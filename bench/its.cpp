// How much processor time its takes, in both modes: medians, and a hash of the result, which tells whether
// two versions of the code give the same.
//
//   build/release/bench/bench_its [RUNS]
#include <fmt/core.h>

#include <algorithm>
#include <cstdlib>
#include <ctime>
#include <span>
#include <string>
#include <vector>

#include "bench/median.h"
#include "core/base/hash.h"
#include "core/sample/sample.h"
#include "core/simplify/registry.h"
#include "tests/support/shapes.h"

namespace coppice {
namespace {

struct Scenario {
    std::string name, mode;
    Mesh mesh;
    std::vector<double> milliseconds = {};
    std::string hash = {};

    void run() {
        const Algorithm& its = find_algorithm("its");
        const ParameterValues parameters = ParameterValues::parse(its.parameters, {{"mode", mode}});
        const std::clock_t start = std::clock();
        const Simplified result =
            its.simplify(mesh, {}, {.triangles = mesh.triangle_count() / 2}, parameters, {});
        milliseconds.push_back(1e3 * static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC);
        Sha256 hash_of_result;
        hash_of_result.update(std::as_bytes(std::span(result.mesh.positions)));
        hash_of_result.update(std::as_bytes(std::span(result.mesh.triangles)));
        hash_of_result.update(std::as_bytes(std::span(&result.error_model_units, 1)));
        hash = hash_of_result.finish_hex().substr(0, 12);
    }
};

}  // namespace
}  // namespace coppice

int main(int count, char** arguments) {
    using namespace coppice;
    const int runs = count > 1 ? std::max(1, std::atoi(arguments[1])) : 5;
    const Mesh bunny = make_sample("bunny13", {}).meshes[0];
    const Mesh blob = shapes::blob({.segments = 1000, .rings = 501});
    std::vector<Scenario> scenarios;
    for (const char* mode : {"full", "faithful"}) scenarios.push_back({"bunny13", mode, bunny});
    scenarios.push_back({"blob", "full", blob});
    // In turns, so that whatever else the machine does falls on all alike.
    for (int i = 0; i < runs; ++i) {
        for (Scenario& scenario : scenarios) scenario.run();
    }
    fmt::print("| mesh | mode | triangles | ms | result |\n|---|---|---:|---:|---|\n");
    for (const Scenario& scenario : scenarios) {
        fmt::print("| {} | {} | {} | {:.1f} | {} |\n", scenario.name, scenario.mode,
                   scenario.mesh.triangle_count(), median(scenario.milliseconds), scenario.hash);
    }
    return 0;
}
