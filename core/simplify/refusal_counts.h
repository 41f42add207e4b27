// Why nothing is left to collapse.
#pragma once

#include <array>
#include <cstdint>

#include "core/simplify/algorithm.h"
#include "core/simplify/collapse_rules.h"

namespace coppice {

class RefusalCounts {
  public:
    void add(Refusal refusal) { ++counts_[static_cast<size_t>(refusal)]; }
    void add_beyond_threshold() { ++beyond_threshold_; }

    // A limit that was set is the reason wherever it stopped anything; else what stopped most.
    StopReason reason() const {
        if (count(Refusal::error) > 0) return StopReason::error_limit;
        if (beyond_threshold_ > 0) return StopReason::threshold;
        if (count(Refusal::topology) == 0 && count(Refusal::bounds) == 0) return StopReason::locked;
        return count(Refusal::topology) >= count(Refusal::bounds) ? StopReason::topology : StopReason::bounds;
    }

  private:
    uint64_t count(Refusal refusal) const { return counts_[static_cast<size_t>(refusal)]; }

    std::array<uint64_t, 5> counts_ = {};  // by Refusal
    uint64_t beyond_threshold_ = 0;        // of a threshold of the algorithm's own
};

}  // namespace coppice
