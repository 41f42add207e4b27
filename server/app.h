// The service put together: stores, slots, routes, HTTP. The one place that builds everything, in order.
#pragma once

#include <memory>

#include "server/config.h"
#include "server/jobs/work.h"
#include "server/telemetry/log.h"

namespace coppice {

// What tests put in the place of the real thing.
struct Parts {
    WorkFunction work = {};  // none: read, simplify, write
    NowFunction now = system_now;
    std::shared_ptr<const Log> log = {};  // none: to standard error
};

class Service {
  public:
    // Opens the data directory, and begins to listen and to work. Throws Error.
    explicit Service(const Config& config, Parts parts = {});
    ~Service();
    Service(const Service&) = delete;
    Service& operator=(const Service&) = delete;

    int port() const;

    // Takes no new work, lets what runs end within Config::drain_time, gives back what does not, answers who
    // waits, and stops to listen. Once.
    void drain();

  private:
    struct State;
    std::unique_ptr<State> state_;
};

// Serves until SIGTERM or SIGINT, then drains; a second signal ends it at once. Returns the process's exit
// code. Has to be called before any other thread is started, so that these threads leave the signals to it.
int run_service(const Config& config);

}  // namespace coppice
