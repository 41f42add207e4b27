// attribute-quadric beside the fastest peer, meshoptimizer's meshopt_simplify: processor time of one thread
// and surface distances, on the same positions in the same run, under the same judge (core/compare).
//
//   build/release/bench/bench_simplify [MESH ...]
//
// Without meshes: the drawn ones, of 100 k and a million triangles. Prints the tables of docs/performance.md.
#include <fmt/core.h>
#include <meshoptimizer.h>

#include <array>
#include <cmath>
#include <filesystem>
#include <functional>
#include <numeric>
#include <string>
#include <string_view>
#include <vector>

#include "bench/median.h"
#include "bench/papers/measure.h"
#include "core/compare/compare_scenes.h"
#include "core/format/asset.h"
#include "core/mesh/bounds.h"
#include "core/simplify/registry.h"
#include "tests/support/shapes.h"
#include "tests/support/test_assets.h"

namespace coppice {
namespace {

struct Named {
    std::string name;
    Mesh mesh;
};

// Positions alone, within a box of diagonal 1: what both are given.
Mesh bare(const Mesh& mesh) {
    const Bounds box = bounds(mesh.positions);
    Mesh result;
    result.slots.resize(1);
    for (const Vec3f p : mesh.positions)
        result.positions.push_back(to_float((to_double(p) - box.min) * (1 / box.diagonal())));
    result.wedge_vertex.resize(mesh.vertex_count());
    std::iota(result.wedge_vertex.begin(), result.wedge_vertex.end(), 0U);
    for (const uint32_t wedge : mesh.triangles) result.triangles.push_back(mesh.wedge_vertex[wedge]);
    result.triangle_slot.resize(mesh.triangle_count());
    return result;
}

// Into indices that are there already: the peer has nothing to allocate for its result.
void by_meshoptimizer(const Mesh& mesh, size_t triangles, Mesh& result) {
    result.triangles.resize(mesh.triangles.size());
    const size_t left = meshopt_simplify(result.triangles.data(), mesh.triangles.data(),
                                         mesh.triangles.size(), &mesh.positions[0].x, mesh.positions.size(),
                                         sizeof(Vec3f), 3 * triangles, 1e9F, 0, nullptr);
    result.triangles.resize(left);
    result.triangle_slot.resize(left / 3);
}

void by_attribute_quadric(const Mesh& mesh, size_t triangles, const std::string& quality, Mesh& result) {
    result =
        papers::simplify(find_algorithm("attribute-quadric"), mesh, triangles, {{"quality", quality}}).mesh;
}

struct Run {
    std::vector<double> times;
    Mesh result;
    Spread distance;
};

// In turns, so that whatever else the machine does falls on all alike.
std::vector<Run> measure(const Mesh& mesh, size_t triangles) {
    const std::vector<std::function<void(Mesh&)>> ways = {
        [&](Mesh& result) { by_meshoptimizer(mesh, triangles, result); },
        [&](Mesh& result) { by_attribute_quadric(mesh, triangles, "fast", result); },
        [&](Mesh& result) { by_attribute_quadric(mesh, triangles, "best", result); }};
    std::vector<Run> runs(ways.size());
    for (Run& run : runs) run.result = mesh;
    for (int turn = 0; turn < papers::runs; ++turn) {
        for (size_t i = 0; i < ways.size(); ++i)
            runs[i].times.push_back(papers::cpu_milliseconds([&] { ways[i](runs[i].result); }));
    }
    for (Run& run : runs) run.distance = compare_meshes(mesh, run.result, {}, {}).symmetric;
    return runs;
}

// Geometric means of ratios to the peer.
struct Ratios {
    double time = 0, root_mean_square = 0, largest = 0;
    int count = 0;

    void add(const Run& ours, const Run& peer) {
        time += std::log(median(ours.times) / median(peer.times));
        root_mean_square += std::log(ours.distance.root_mean_square / peer.distance.root_mean_square);
        largest += std::log(ours.distance.largest / peer.distance.largest);
        ++count;
    }
    std::string text() const {
        const auto mean = [this](double sum) { return std::exp(sum / count); };
        return fmt::format("{:.2f} | {:.2f} | {:.2f}", mean(time), mean(root_mean_square), mean(largest));
    }
};

void print(const std::vector<Named>& meshes) {
    constexpr std::array<std::string_view, 3> names = {"meshoptimizer", "fast", "best"};
    std::array<Ratios, 3> ratios;
    fmt::print(
        "meshoptimizer {}.{}; processor time of one thread, medians of {} in turns; distances of the larger "
        "direction in 1e-4 of the diagonal.\n\n"
        "| mesh | kept | | triangles | ms | root mean square | largest "
        "|\n|---|---:|---|---:|---:|---:|---:|\n",
        MESHOPTIMIZER_VERSION / 1000, MESHOPTIMIZER_VERSION / 10 % 100, papers::runs);
    for (const Named& named : meshes) {
        const Mesh mesh = bare(named.mesh);
        for (const double kept : {0.5, 0.2, 0.1, 0.01}) {
            const std::vector<Run> runs =
                measure(mesh, static_cast<size_t>(kept * static_cast<double>(mesh.triangle_count())));
            for (size_t i = 0; i < runs.size(); ++i) {
                fmt::print("| {} | {} % | {} | {} | {:.1f} | {:.3f} | {:.2f} |\n", named.name, 100 * kept,
                           names[i], runs[i].result.triangle_count(), median(runs[i].times),
                           1e4 * runs[i].distance.root_mean_square, 1e4 * runs[i].distance.largest);
                ratios[i].add(runs[i], runs[0]);
            }
        }
    }
    fmt::print(
        "\nTo meshoptimizer, geometric means:\n\n| | time | root mean square | largest "
        "|\n|---|---:|---:|---:|\n");
    for (size_t i = 1; i < names.size(); ++i) fmt::print("| {} | {} |\n", names[i], ratios[i].text());
}

}  // namespace
}  // namespace coppice

int main(int count, char** words) {
    using namespace coppice;
    std::vector<Named> meshes;
    for (int i = 1; i < count; ++i) {
        const test::UploadedAsset asset{std::filesystem::path(words[i])};
        const Scene scene = read_asset(asset.upload(), {}, Watch{}).scene;
        meshes.push_back({std::filesystem::path(words[i]).filename(), scene.meshes.at(0)});
    }
    if (meshes.empty()) {
        for (const uint32_t segments : {273U, 863U}) {
            const Mesh mesh = shapes::blob({.segments = segments, .rings = 2 * segments / 3});
            meshes.push_back({fmt::format("drawn, {} triangles", mesh.triangle_count()), mesh});
        }
    }
    print(meshes);
}
