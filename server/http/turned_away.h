// Connections that are refused as they come: they get an answer, and cost no thread.
#pragma once

#include <chrono>
#include <deque>
#include <string_view>

#include "core/base/descriptor.h"

namespace coppice {

// Closed at once, a socket on which a request still arrives would be reset, and the answer lost with it. So
// each is kept for a moment; of many, the newest. One thread.
class TurnedAway {
  public:
    using Clock = std::chrono::steady_clock;

    void turn_away(Descriptor socket, std::string_view answer);

    void tidy(Clock::time_point now = Clock::now());  // closes those that have had their moment
    bool empty() const { return kept_.empty(); }

  private:
    struct Kept {
        Descriptor socket;
        Clock::time_point until;
    };
    std::deque<Kept> kept_;  // oldest first
};

}  // namespace coppice
