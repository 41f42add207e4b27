#include "core/simplify/cluster_rounds.h"

#include <algorithm>

#include "core/simplify/threshold_search.h"

namespace coppice {

namespace {

constexpr uint32_t most_rounds = 200;
constexpr double least_progress = 0.002;  // of the triangles; a round with less widens the next one
constexpr double widening = 1.5;

}  // namespace

RoundsDone run_rounds(ClusterStage& stage, const Target& target, const RoundOptions& options,
                      const Watch& watch) {
    const bool seeks = target.triangles || target.vertices ||
                       (target.error_model_units && !options.threshold && !options.rounds);
    const uint32_t rounds = options.rounds.value_or(seeks ? most_rounds : 1);
    RoundsDone result;
    double accepted = 0.96;  // part of what counts promise; what the last round had
    double widened = 1;
    bool exhausted = false;
    for (uint32_t round = 0; round < rounds && !stage.done() && !exhausted; ++round) {
        stage.begin_round(watch);
        const double most =
            std::min(options.threshold.value_or(stage.largest_threshold()), stage.largest_threshold());
        const double before = stage.live_triangles();
        double threshold = most, promised = 0;
        if (seeks) {
            const double saving = (before - stage.target_triangles()) / accepted;
            const bool last = round + 1 == rounds, patient = options.patient && !last;
            const double usual = std::min(most, (patient ? widened : 1) * stage.usual_threshold());
            const auto count = [&](double t) {
                watch.check();
                return t > 0 ? stage.count(t, watch) : before;
            };
            ThresholdSearch search = {
                .most = usual, .target = std::max(0.0, before - saving), .tolerance = 0.01};
            ThresholdFound found = search_threshold(search, count);  // cheap where it is enough
            if (!found.reached && usual < most && !patient) {
                search.least = usual, search.most = most;
                found = search_threshold(search, count);
            }
            threshold = found.reached || last || patient ? found.threshold
                                                         : std::min(most, widened * stage.usual_threshold());
            promised = before - (threshold == found.threshold ? found.count : stage.count(threshold, watch));
        }
        stage.run(threshold, watch);
        watch.report(stage.fraction());
        result.threshold = std::max(result.threshold, threshold);
        const double saved = before - stage.live_triangles();
        if (promised > 0) accepted = std::clamp(saved / promised, 0.2, 1.0);
        if (saved >= least_progress * before) continue;
        exhausted = threshold >= most;
        widened *= widening;
    }
    if (stage.done()) return result;
    const bool by_threshold = options.threshold && result.threshold >= *options.threshold;
    const bool by_rounds = options.rounds && !exhausted;
    result.reason = by_threshold || by_rounds ? StopReason::threshold : stage.reason_for_refusals();
    return result;
}

}  // namespace coppice
