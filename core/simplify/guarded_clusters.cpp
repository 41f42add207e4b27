#include "core/simplify/guarded_clusters.h"

#include <algorithm>

#include "core/base/watched_loop.h"
#include "core/simplify/delaunay_flips.h"

namespace coppice {

namespace {

class GuardedStage final : public ClusterStage {
  public:
    GuardedStage(StarContraction& work, ClusterRule& rule, const Target& target)
        : work_(work), rule_(rule), target_(target) {}

    double live_triangles() const override { return work_.mesh().live_triangles(); }
    bool done() const override { return work_.done(); }
    double fraction() const override { return work_.fraction(); }

    double target_triangles() const override { return triangles_when_met(target_, work_.mesh()); }

    void begin_round(const Watch& watch) override {
        work_.forget_refusals();
        rule_.begin_round(work_.mesh(), watch);
    }
    double usual_threshold() const override { return rule_.usual_threshold(); }
    double largest_threshold() const override { return rule_.largest_threshold(); }

    double count(double threshold, const Watch& watch) override {
        double left = live_triangles();
        WatchedSteps steps(watch);
        rule_.offer(threshold, [&](std::span<const uint32_t> vertices) {
            steps.add(1);
            if (!work_.kinds_allow(vertices)) return size_t{0};
            left -= work_.triangles_saved(vertices);
            return vertices.size();
        });
        return left;
    }

    void run(double threshold, const Watch& watch) override {
        uint64_t step = 0;
        rule_.offer(threshold, [&](std::span<const uint32_t> vertices) {
            if (work_.done()) return size_t{0};
            if (++step % 64 == 0) watch.check();
            if (step % 1024 == 0) watch.report(work_.fraction());
            for (vertices = vertices.first(std::min(vertices.size(), most_to_merge())); vertices.size() > 1;
                 vertices = vertices.first(vertices.size() / 2)) {
                const Placement placement = rule_.place(work_.mesh(), vertices);
                if (work_.try_contract(vertices, placement) == Refusal::none) return vertices.size();
            }
            return size_t{0};
        });
    }

    StopReason reason_for_refusals() const override { return work_.reason_for_refusals(); }

  private:
    // So that the last set does not go far beyond the target.
    size_t most_to_merge() const {
        const double to_go = live_triangles() - target_triangles();
        return static_cast<size_t>(std::max(2.0, to_go / 2 + 1.5));
    }

    StarContraction& work_;
    ClusterRule& rule_;
    const Target& target_;
};

}  // namespace

Simplified simplify_by_guarded_clusters(const Mesh& source, const Target& target, ClusterRule& rule,
                                        const RoundOptions& options, const Watch& watch) {
    StarContraction work(source, target, watch);
    GuardedStage stage(work, rule, target);
    const RoundsDone done = run_rounds(stage, target, options, watch);
    delaunay_flips(work.mesh(), work.uvs(), watch);
    watch.report(1.0);
    Simplified result = work.finish(done.reason, watch);
    result.threshold_used = done.threshold;
    return result;
}

}  // namespace coppice
