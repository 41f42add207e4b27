// The rounds of a clustering algorithm: how far each goes, and when to stop.
#pragma once

#include <optional>

#include "core/simplify/algorithm.h"

namespace coppice {

// One simplification by rounds, each of steps that a threshold lets through: merges of vertices within a
// length, in mesh units, or removals where the surface bends by at most an angle, in degrees. Larger
// thresholds let more through.
class ClusterStage {
  public:
    ClusterStage() = default;
    virtual ~ClusterStage() = default;
    ClusterStage(const ClusterStage&) = delete;
    ClusterStage& operator=(const ClusterStage&) = delete;

    virtual double live_triangles() const = 0;
    virtual bool done() const = 0;        // the target's triangles or vertices are met
    virtual double fraction() const = 0;  // of the way there
    // The triangles at which it will be, about.
    virtual double target_triangles() const = 0;
    virtual void begin_round(const Watch& watch) = 0;
    virtual double usual_threshold() const = 0;    // lets most sets of the round through
    virtual double largest_threshold() const = 0;  // lets all of them through
    // What a round at that threshold would leave, if nothing was refused. Changes nothing.
    virtual double count(double threshold, const Watch& watch) = 0;
    virtual void run(double threshold, const Watch& watch) = 0;
    virtual StopReason reason_for_refusals() const = 0;
};

struct RoundOptions {
    std::optional<double> threshold = {};  // the algorithm's own, in the stage's unit
    std::optional<uint32_t> rounds = {};
    // Goes beyond the usual threshold only where further rounds at it no longer help: for merges that leave
    // as much to do at the same threshold.
    bool patient = false;
};

struct RoundsDone {
    StopReason reason = StopReason::target;
    double threshold = 0;  // the largest that a round had
};

// A threshold alone: one round at it. With a target, rounds until it is met, each at the smallest threshold
// that meets it, found by search of counts; while there is none, at the usual one, so that what is small goes
// first. Never beyond options.threshold.
RoundsDone run_rounds(ClusterStage& stage, const Target& target, const RoundOptions& options,
                      const Watch& watch);

}  // namespace coppice
