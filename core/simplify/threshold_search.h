// The threshold at which an algorithm leaves as many triangles as were asked for.
#pragma once

#include <cstdint>
#include <functional>

namespace coppice {

struct ThresholdSearch {
    double least = 0;  // leaves all
    double most = 0;   // what is never gone beyond
    double target = 0;
    double tolerance = 0.004;  // of the target: near enough
    uint32_t runs = 24;        // of count, at most
};

struct ThresholdFound {
    double threshold = 0;
    double count = 0;
    bool reached = false;  // else `most` leaves more than the target; threshold is `most`
};

// The smallest threshold, about, whose count is at or below the target. count: what a run at a threshold
// leaves, or an estimate of it; falls, on the whole, as the threshold grows. Where it jumps past the target,
// the threshold is just beyond the jump. Deterministic.
ThresholdFound search_threshold(const ThresholdSearch& search, const std::function<double(double)>& count);

}  // namespace coppice
