#include "core/simplify/plain_clusters.h"

#include <algorithm>
#include <limits>

#include "core/mesh/bounds.h"
#include "core/simplify/delaunay_flips.h"
#include "core/simplify/mean_edge.h"
#include "core/simplify/threshold_search.h"

namespace coppice {

namespace {

constexpr uint64_t no_limit = std::numeric_limits<uint64_t>::max();

class PlainStage final : public ClusterStage {
  public:
    PlainStage(const Mesh& source, const Target& target, const PlainPass& pass)
        : source_(source),
          target_(target),
          pass_(pass),
          clusters_(source),
          mean_edge_(mean_edge(source)),
          diagonal_(bounds(source.positions).diagonal()),
          first_(clusters_.count(source)),
          now_(first_) {}

    VertexClusters& clusters() { return clusters_; }

    double live_triangles() const override { return static_cast<double>(now_.triangles); }
    bool done() const override {
        return (target_.triangles && now_.triangles <= *target_.triangles) ||
               (target_.vertices && now_.vertices <= *target_.vertices);
    }
    double fraction() const override {
        const double from = static_cast<double>(first_.triangles), to = target_triangles();
        return from > to ? std::clamp((from - live_triangles()) / (from - to), 0.0, 1.0) : 1;
    }
    double target_triangles() const override {
        if (target_.triangles) return static_cast<double>(*target_.triangles);
        if (!target_.vertices) return 0;
        return std::max(0.0, live_triangles() - 2.0 * (static_cast<double>(now_.vertices) -
                                                       static_cast<double>(*target_.vertices)));
    }
    void begin_round(const Watch& watch) override {
        watch.check();
        clusters_.begin_round();
    }
    double usual_threshold() const override { return 2 * mean_edge_; }
    double largest_threshold() const override { return diagonal_; }
    double count(double threshold, const Watch& watch) override {
        watch.check();
        return count(threshold, no_limit);
    }

    // Where the count jumps past the target, it stops half-way through the pass.
    void run(double threshold, const Watch& watch) override {
        const double wanted = target_triangles();
        VertexClusters before = clusters_;
        const uint64_t merges = pass_(clusters_, threshold, no_limit);
        now_ = clusters_.count(source_);
        if (!(live_triangles() < wanted * 0.99 - 1)) return;
        const ThresholdFound found =
            search_threshold({.most = static_cast<double>(merges),
                              .target = wanted,
                              .tolerance = 1 / (wanted + 1),
                              .runs = 48},
                             [&](double most) {
                                 watch.check();
                                 VertexClusters trial = before;
                                 pass_(trial, threshold, static_cast<uint64_t>(most));
                                 return static_cast<double>(trial.count(source_).triangles);
                             });
        clusters_ = before;
        pass_(clusters_, threshold, static_cast<uint64_t>(found.threshold));
        now_ = clusters_.count(source_);
    }

    StopReason reason_for_refusals() const override { return StopReason::topology; }

  private:
    double count(double threshold, uint64_t most) {
        VertexClusters trial = clusters_;
        pass_(trial, threshold, most);
        return static_cast<double>(trial.count(source_).triangles);
    }

    const Mesh& source_;
    const Target& target_;
    const PlainPass& pass_;
    VertexClusters clusters_;
    double mean_edge_, diagonal_;
    VertexClusters::Count first_, now_;
};

}  // namespace

Simplified simplify_by_plain_clusters(const Mesh& source, const Target& target, const PlainPass& pass,
                                      const RoundOptions& options, const Watch& watch) {
    PlainStage stage(source, target, pass);
    RoundOptions limited = options;
    if (target.error_model_units) {  // nothing moves by more than a threshold of half as much
        limited.threshold = std::min(options.threshold.value_or(*target.error_model_units / 2),
                                     *target.error_model_units / 2);
    }
    const RoundsDone done = run_rounds(stage, target, limited, watch);
    const Mesh clustered = stage.clusters().extract(source, watch);
    CollapseMesh mesh(clustered, watch);
    const UvGuard uvs(mesh, clustered, watch);
    delaunay_flips(mesh, uvs, watch);
    watch.report(1.0);
    return {.mesh = mesh.extract(clustered, watch),
            .error_model_units = stage.clusters().largest_move(source),
            .certified = false,
            .stop_reason = done.reason,
            .threshold_used = done.threshold};
}

}  // namespace coppice
