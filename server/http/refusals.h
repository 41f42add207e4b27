// Connections that were refused as they came, told once a second and not one by one: a flood of them must not
// become a flood of lines in the log.
#pragma once

#include <chrono>
#include <map>

#include "server/http/exchange.h"

namespace coppice {

// One thread.
class Refusals {
  public:
    using Clock = std::chrono::steady_clock;

    explicit Refusals(const Observe& observe) : observe_(observe) {}  // which has to outlive it
    ~Refusals();                                                      // tells what is left
    Refusals(const Refusals&) = delete;
    Refusals& operator=(const Refusals&) = delete;

    void add(Exchange refused, Clock::time_point now = Clock::now());

    // Those of each status that have waited for their second.
    void tell(Clock::time_point now = Clock::now());

  private:
    struct Alike {
        Exchange last;
        uint64_t untold = 0;
        Clock::time_point told_at = {};  // long ago: the first of all is told at once
    };
    void tell(Alike& alike, Clock::time_point now) const;

    const Observe& observe_;
    std::map<int, Alike> by_status_;
};

}  // namespace coppice
