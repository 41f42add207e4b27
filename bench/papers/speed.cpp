// Speed beside OpenMesh's decimater on the same mesh in the same run, and how time grows.
#include <fmt/core.h>

#include <cmath>
#include <cstdio>
#include <vector>

#include "bench/openmesh/decimate.h"
#include "bench/papers/measure.h"
#include "bench/papers/models.h"
#include "bench/papers/tables.h"
#include "tests/heap/heap_use.h"

namespace coppice::papers {
namespace {

// What the time is to be, at most, of OpenMesh's. None of OpenMesh itself behind our interface.
struct Goal {
    std::string_view algorithm;
    double to_openmesh;
};

constexpr Goal goals[] = {
    {"vt", 0.1},       {"fad", 0.1},  {"ivdd", 0.1},          {"ss", 0.1},
    {"vtd", 0.1},      {"fass", 0.1}, {"surface-angle", 0.1}, {"gaea", 0.15},
    {"quadric", 0.35}, {"ias", 0.35}, {"its", 0.35},          {"gaps", 0.6},
};

std::string judged(std::string_view algorithm, double to_openmesh) {
    for (const Goal& goal : goals) {
        if (goal.algorithm == algorithm)
            return fmt::format("{} | {}", goal.to_openmesh,
                               to_openmesh <= goal.to_openmesh ? "met" : "missed");
    }
    return " | ";
}

peer::Triangles as_triangles(const Mesh& mesh) {
    peer::Triangles result;
    for (const Vec3f p : mesh.positions) result.positions.insert(result.positions.end(), {p.x, p.y, p.z});
    for (const uint32_t wedge : mesh.triangles) result.corners.push_back(mesh.wedge_vertex[wedge]);
    return result;
}

}  // namespace

// In turns, so that whatever else the machine does falls on all alike.
void print_speed() {
    const Model bunny = model("models/stanford-bunny.obj", 69451);
    const peer::Triangles plain = as_triangles(bunny.mesh);
    const size_t half = bunny.mesh.triangle_count() / 2;
    std::vector<double> openmesh;
    std::vector<std::vector<double>> times(algorithms().size());
    std::vector<Simplified> results(algorithms().size());
    for (int run = 0; run < runs; ++run) {
        openmesh.push_back(cpu_milliseconds([&] { peer::decimate_with_openmesh(plain, half); }));
        for (size_t a = 0; a < algorithms().size(); ++a) {
            times[a].push_back(
                cpu_milliseconds([&] { results[a] = simplify(algorithms()[a], bunny.mesh, half); }));
        }
    }
    fmt::print(
        "\n### Speed\n\n{}, {} triangles to {}, processor time of one thread, medians of {}. OpenMesh's "
        "decimater, "
        "compiled without checks: {:.0f} ms.\n\n",
        bunny.name, bunny.mesh.triangle_count(), half, runs, median(openmesh));
    fmt::print(
        "| algorithm | triangles | stopped for | ms | to OpenMesh | goal | "
        "|\n|---|---:|---|---:|---:|---:|---|\n");
    for (size_t a = 0; a < algorithms().size(); ++a) {
        const double ratio = median(times[a]) / median(openmesh);
        fmt::print("| {} | {} | {} | {:.0f} | {:.2f} | {} |\n", algorithms()[a].id,
                   results[a].mesh.triangle_count(), name(results[a].stop_reason), median(times[a]), ratio,
                   judged(algorithms()[a].id, ratio));
    }
}

// time ~ triangles^exponent, between the smallest and the largest. Memory is what is allocated beside the
// mesh at the peak, the result included.
void print_growth() {
    const std::vector<uint32_t> sizes = {10'000, 100'000, 1'000'000, 4'000'000};
    std::vector<Mesh> meshes;
    for (const uint32_t size : sizes) meshes.push_back(drawn_model(size).mesh);
    fmt::print(
        "\n### Growth\n\nms of processor time to 50 %, one run; bytes beside the mesh at the peak, for each "
        "triangle "
        "of the largest.\n\n| algorithm | 10 k | 100 k | 1 M | 4 M | exponent | bytes a triangle | declared "
        "|\n|---|---:|---:|---:|---:|---:|---:|---:|\n");
    for (const Algorithm& algorithm : algorithms()) {
        std::vector<double> times, bytes;
        for (const Mesh& mesh : meshes) {
            const test::HeapUse heap;
            times.push_back(cpu_milliseconds([&] { simplify(algorithm, mesh, mesh.triangle_count() / 2); }));
            bytes.push_back(static_cast<double>(heap.peak_bytes()) /
                            static_cast<double>(mesh.triangle_count()));
        }
        const double grown = static_cast<double>(meshes.back().triangle_count()) /
                             static_cast<double>(meshes.front().triangle_count());
        fmt::print("| {} | {:.0f} | {:.0f} | {:.0f} | {:.0f} | {:.2f} | {:.0f} | {} |\n", algorithm.id,
                   times[0], times[1], times[2], times[3],
                   std::log(times.back() / times.front()) / std::log(grown), bytes.back(),
                   algorithm.bytes_per_triangle);
        std::fflush(stdout);
    }
}

}  // namespace coppice::papers
