#include "server/http/refusals.h"

#include <utility>

namespace coppice {
namespace {

constexpr std::chrono::seconds tell_every{1};

}  // namespace

Refusals::~Refusals() {
    try {
        for (auto& [status, alike] : by_status_) tell(alike, {});
    } catch (...) {  // no memory to tell it
    }
}

void Refusals::add(Exchange refused, Clock::time_point now) {
    Alike& alike = by_status_[refused.status];
    alike.last = std::move(refused);
    ++alike.untold;
    tell(now);
}

void Refusals::tell(Clock::time_point now) {
    for (auto& [status, alike] : by_status_) {
        if (now - alike.told_at >= tell_every) tell(alike, now);
    }
}

void Refusals::tell(Alike& alike, Clock::time_point now) const {
    if (alike.untold == 0) return;
    alike.last.count = std::exchange(alike.untold, 0);
    alike.told_at = now;
    if (observe_) observe_(alike.last);
}

}  // namespace coppice
