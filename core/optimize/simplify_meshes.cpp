#include "core/optimize/simplify_meshes.h"

#include <algorithm>
#include <atomic>
#include <mutex>
#include <numeric>
#include <thread>

#include "core/base/parallel.h"

namespace coppice {

namespace {

// Adds up what meshes that are simplified at the same time report, each weighed by its triangles.
class SharedProgress {
  public:
    SharedProgress(const Watch& watch, const std::vector<Mesh>& meshes)
        : watch_(watch), done_(meshes.size(), 0) {
        for (const Mesh& mesh : meshes) weights_.push_back(static_cast<double>(mesh.triangle_count() + 1));
        total_ = std::accumulate(weights_.begin(), weights_.end(), 0.0);
    }

    Watch of_mesh(size_t mesh) {
        Watch watch = watch_;
        watch.progress = [this, mesh](double fraction) { advance(mesh, fraction); };
        return watch;
    }

  private:
    void advance(size_t mesh, double fraction) {
        const std::scoped_lock lock(mutex_);
        sum_ += weights_[mesh] * std::max(0.0, fraction - done_[mesh]);
        done_[mesh] = std::max(done_[mesh], fraction);
        const double told = std::min(1.0, sum_ / total_);
        if (!watch_.progress || told < told_ + 0.002) return;  // 500 steps are enough for whoever listens
        told_ = told;
        watch_.progress(told);
    }

    const Watch& watch_;
    std::mutex mutex_;
    std::vector<double> weights_, done_;
    double total_ = 0, sum_ = 0, told_ = 0;
};

std::vector<size_t> largest_first(const std::vector<Mesh>& meshes) {
    std::vector<size_t> order(meshes.size());
    std::iota(order.begin(), order.end(), size_t{0});
    std::stable_sort(order.begin(), order.end(), [&](size_t a, size_t b) {
        return meshes[a].triangle_count() > meshes[b].triangle_count();
    });
    return order;
}

// Points and lines have no triangles to take away.
Simplified unchanged(const Mesh& mesh) {
    return {.mesh = mesh, .stop_reason = StopReason::already_smaller};
}

}  // namespace

std::vector<Simplified> simplify_meshes(const std::vector<Mesh>& meshes, const Placement& placement,
                                        const std::vector<Target>& targets, const Algorithm& algorithm,
                                        const ParameterValues& parameters, unsigned threads,
                                        const Watch& watch) {
    std::vector<Simplified> results(meshes.size());
    SharedProgress progress(watch, meshes);
    const auto simplify = [&](size_t i) {
        const Watch own = progress.of_mesh(i);
        own.check();
        results[i] = meshes[i].triangle_count() == 0
                         ? unchanged(meshes[i])
                         : algorithm.simplify(meshes[i], placement.of_mesh[i], targets[i], parameters, own);
        own.report(1);
    };
    // Each worker takes the largest mesh that is left: the big ones start first, and no thread waits for a
    // share that was dealt out before. Which worker does what is chance; where results go is not.
    const std::vector<size_t> order = largest_first(meshes);
    const size_t workers = threads > 0 ? threads : std::max(1U, std::thread::hardware_concurrency());
    std::atomic<size_t> next = 0;
    parallel_for(std::min(workers, meshes.size()), threads, [&](size_t) {
        for (size_t k = next++; k < order.size(); k = next++) simplify(order[k]);
    });
    watch.report(1);
    return results;
}

}  // namespace coppice
