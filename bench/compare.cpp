// What a comparison costs: nearest points over triangles and threads, and a whole comparison. Prints tables;
// ratios are of medians, measured in turns, so that whatever else the machine does falls on all alike.
//
//   build/release/bench/bench_compare
#include <fmt/core.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <functional>
#include <vector>

#include "core/compare/compare_scenes.h"
#include "core/compare/deviation.h"
#include "core/compare/distance_bounds.h"
#include "tests/support/shapes.h"

namespace coppice {
namespace {

double milliseconds(const std::function<void()>& work) {
    const auto begin = std::chrono::steady_clock::now();
    work();
    const std::chrono::duration<double, std::milli> time = std::chrono::steady_clock::now() - begin;
    return time.count();
}

double median(std::vector<double> values) {
    std::nth_element(values.begin(), values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2),
                     values.end());
    return values[values.size() / 2];
}

// A bumpy ball with about that many triangles.
Mesh ball(size_t triangles) {
    const auto rings = static_cast<uint32_t>(std::sqrt(static_cast<double>(triangles) / 3));
    return shapes::blob({.segments = rings * 3 / 2, .rings = rings});
}

struct Size {
    Mesh fine, rough;
    std::vector<double> build = {}, queries = {}, flips = {}, bounds = {}, self = {};
    size_t samples = 0;

    void run() {
        Surface reference, candidate;
        std::unique_ptr<Bvh> tree, tree_of_reference;
        build.push_back(milliseconds([&] {
            reference = make_surface(fine, {});
            candidate = make_surface(rough, {});
            tree = std::make_unique<Bvh>(candidate, 1, Watch{});
            tree_of_reference = std::make_unique<Bvh>(reference, 1, Watch{});
        }));
        const double diagonal = reference.bounds.diagonal();
        samples = 10 * reference.triangle_count();
        queries.push_back(milliseconds([&] {
            measure_deviation(reference, {candidate, *tree, diagonal}, texture_scale(reference, {}),
                              {.count = samples}, 1, {});
        }));
        flips.push_back(milliseconds([&] {
            count_flips({reference, *tree_of_reference, diagonal}, candidate, 1, {});
        }));
        bounds.push_back(milliseconds([&] { distance_bounds(reference, *tree, 1e-4 * diagonal, 1, {}); }));
        self.push_back(milliseconds([&] { find_self_intersections(reference, *tree_of_reference, 1, {}); }));
    }
};

void sizes() {
    std::vector<Size> all;
    for (const size_t triangles : {10'000U, 40'000U, 160'000U, 640'000U})
        all.push_back({ball(triangles), ball(triangles / 4)});
    for (int run = 0; run < 3; ++run) {
        for (Size& size : all) size.run();
    }
    fmt::print(
        "A mesh against one with a quarter of its triangles, one thread, medians of 3 runs.\n\n"
        "| triangles | both trees, us a triangle | 10 samples a triangle, us each | flips, us a triangle | "
        "certified "
        "bounds, us a triangle | self-intersections, us a triangle |\n|---:|---:|---:|---:|---:|---:|\n");
    for (const Size& size : all) {
        const auto triangles = static_cast<double>(size.fine.triangle_count());
        const auto each = [](const std::vector<double>& times, double count) {
            return 1000 * median(times) / count;
        };
        fmt::print("| {} | {:.2f} | {:.2f} | {:.2f} | {:.2f} | {:.2f} |\n", size.fine.triangle_count(),
                   each(size.build, triangles + static_cast<double>(size.rough.triangle_count())),
                   each(size.queries, static_cast<double>(size.samples)),
                   each(size.flips, static_cast<double>(size.rough.triangle_count())),
                   each(size.bounds, triangles), each(size.self, triangles));
    }
    const auto total = [](const Size& size) {
        return median(size.build) + median(size.queries) + median(size.flips);
    };
    const double growth = std::log(total(all.back()) / total(all.front())) /
                          std::log(static_cast<double>(all.back().fine.triangle_count()) /
                                   static_cast<double>(all.front().fine.triangle_count()));
    fmt::print("\nTime grows with triangles to the power of {:.2f}.\n\n", growth);
}

void threads() {
    const Mesh fine = ball(100'000), rough = ball(25'000);
    const std::vector<unsigned> counts = {1, 2};
    std::vector<std::vector<double>> times(counts.size());
    for (int run = 0; run < 3; ++run) {
        for (size_t i = 0; i < counts.size(); ++i) {
            times[i].push_back(
                milliseconds([&] { compare_meshes(fine, rough, {.threads = counts[i]}, {}); }));
        }
    }
    fmt::print(
        "A whole comparison of {} triangles with {}:\n\n| threads | times as fast as one |\n|---:|---:|\n",
        fine.triangle_count(), rough.triangle_count());
    for (size_t i = 0; i < counts.size(); ++i)
        fmt::print("| {} | {:.2f} |\n", counts[i], median(times[0]) / median(times[i]));
}

}  // namespace
}  // namespace coppice

int main() {
    coppice::sizes();
    coppice::threads();
    return 0;
}
