// What everything long takes along: a way to be stopped and a place to tell how far it is.
#pragma once

#include <functional>
#include <stop_token>
#include <string_view>

namespace coppice {

// Copyable; the callbacks may be called from any thread that core runs on, one at a time unless they say
// else.
struct Watch {
    std::stop_token stop = {};
    std::function<void(double fraction)> progress = {};  // 0..1, never goes back
    std::function<void(std::string_view stage)> stage =
        {};  // read, discover, simplify, encode, write; compare
    // Called by every check(), from any thread and several at a time: how tests and benchmarks see how often
    // the stop is looked at.
    std::function<void()> checked = {};

    // Throws Error{job_cancelled} once stop was requested. Cheap; called at least every 50 ms.
    void check() const;

    // check(), then tells progress.
    void report(double fraction) const;

    // The same watch for a part of the work: its 0..1 is this one's begin..end.
    Watch part(double begin, double end) const;
};

}  // namespace coppice
