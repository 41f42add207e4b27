// The port that the service listens on.
#pragma once

#include <atomic>
#include <chrono>
#include <optional>
#include <string>

#include "core/base/descriptor.h"

namespace coppice {

struct Accepted {
    Descriptor socket;
    std::string address;  // of the client, as digits; empty where it cannot be told
};

class Listener {
  public:
    // Binds and listens; port 0 takes a free one. Throws Error that names address and port, and says what
    // would be right.
    Listener(const std::string& host, int port);

    int port() const { return port_; }

    // The next connection; none when the time is over, listening has ended, or there was one that could not
    // be taken: where descriptors or memory have run out, it waits a little, for others to give some back.
    std::optional<Accepted> accept(std::chrono::milliseconds at_most);

    void stop();  // from any thread
    bool is_stopped() const { return stopped_; }

  private:
    Descriptor socket_;
    int port_ = 0;
    std::atomic<bool> stopped_ = false;
};

}  // namespace coppice
