// How long simplification algorithms take, on one thread, and what they leave. Processor time, which other
// work on the machine disturbs less.
//
//   build/release/bench/bench_simplify_family MESH.obj [RATIO [ID ...]]
//   build/release/bench/bench_simplify_family growth [ID ...]
//
// growth: blobs of 10 k to 4 M triangles at ratio 0.5, with the exponent of the growth.
#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <ctime>
#include <filesystem>
#include <string>
#include <vector>

#include "core/format/asset.h"
#include "core/simplify/registry.h"
#include "tests/support/shapes.h"
#include "tests/support/test_assets.h"

namespace coppice {
namespace {

struct Timed {
    double milliseconds = 0;
    Simplified simplified;
};

Timed median_run(const Algorithm& a, const Mesh& mesh, double ratio, int runs) {
    const Target target = {.triangles =
                               static_cast<uint64_t>(ratio * static_cast<double>(mesh.triangle_count()))};
    const ParameterValues values = ParameterValues::parse(a.parameters, {});
    std::vector<double> times;
    Timed result;
    for (int i = 0; i < runs; ++i) {
        const std::clock_t start = std::clock();
        result.simplified = a.simplify(mesh, {}, target, values, Watch{});
        times.push_back(1000.0 * static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC);
    }
    std::sort(times.begin(), times.end());
    result.milliseconds = times[times.size() / 2];
    return result;
}

bool is_asked_for(const Algorithm& a, const std::vector<std::string>& ids) {
    return ids.empty() || std::find(ids.begin(), ids.end(), a.id) != ids.end();
}

void print_mesh(const Mesh& mesh, double ratio, const std::vector<std::string>& ids) {
    fmt::print("{} triangles, ratio {}, one thread, medians of 9 runs.\n\n", mesh.triangle_count(), ratio);
    fmt::print("| algorithm | ms | triangles | threshold | stopped by |\n|---|---:|---:|---:|---|\n");
    for (const Algorithm& a : algorithms()) {
        if (!is_asked_for(a, ids)) continue;
        const Timed t = median_run(a, mesh, ratio, 9);
        fmt::print("| {} | {:.1f} | {} | {:.4g} | {} |\n", a.id, t.milliseconds,
                   t.simplified.mesh.triangle_count(), t.simplified.threshold_used.value_or(0),
                   name(t.simplified.stop_reason));
    }
}

void print_growth(const std::vector<std::string>& ids) {
    const std::vector<uint32_t> segments = {86, 273, 863, 1733};
    fmt::print("| algorithm |");
    for (const uint32_t s : segments) fmt::print(" {} triangles, ms |", 2 * s * (2 * s / 3 - 1));
    fmt::print(" exponent |\n|---|---:|---:|---:|---:|---:|\n");
    for (const Algorithm& a : algorithms()) {
        if (!is_asked_for(a, ids)) continue;
        fmt::print("| {} |", a.id);
        std::vector<double> times, sizes;
        for (const uint32_t s : segments) {
            const Mesh mesh = shapes::blob({.segments = s, .rings = 2 * s / 3});
            times.push_back(median_run(a, mesh, 0.5, s > 500 ? 1 : 5).milliseconds);
            sizes.push_back(static_cast<double>(mesh.triangle_count()));
            fmt::print(" {:.1f} |", times.back());
        }
        fmt::print(" {:.2f} |\n",
                   std::log(times.back() / times.front()) / std::log(sizes.back() / sizes.front()));
    }
}

}  // namespace
}  // namespace coppice

int main(int count, char** words) {
    using namespace coppice;
    const std::vector<std::string> arguments(words + 1, words + count);
    if (arguments.empty() || arguments[0] == "growth") {
        print_growth({arguments.begin() + std::min<std::ptrdiff_t>(1, count - 1), arguments.end()});
        return 0;
    }
    const test::UploadedAsset asset{std::filesystem::path(arguments[0])};
    const Scene scene = read_asset(asset.upload(), {}, Watch{}).scene;
    const double ratio = count > 2 ? std::atof(arguments[1].c_str()) : 0.5;
    print_mesh(scene.meshes.at(0), ratio, {arguments.begin() + std::min(2, count - 1), arguments.end()});
    return 0;
}
