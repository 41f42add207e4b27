// Who is connected: caps, and a way to end idle connections and, later, all.
#pragma once

#include <chrono>
#include <condition_variable>
#include <map>
#include <mutex>
#include <string>

#include "server/http/limits.h"

namespace coppice {

// Thread-safe.
class Connections {
  public:
    explicit Connections(const HttpLimits& limits) : limits_(limits) {}

    enum class Verdict { welcome, too_many, too_many_from_address };

    // Counts the connection, unless its address has as many as it may have.
    Verdict open(int socket, const std::string& address);
    // Of one that counts; before its descriptor is closed.
    void close(int socket, const std::string& address);

    // Between requests stop_idle() may end it. False: it already has.
    bool begin_idle(int socket);
    void end_idle(int socket);

    void stop_idle();  // from now on, every connection ends once it is idle
    bool is_stopping();
    bool wait_until_empty(std::chrono::milliseconds at_most);
    void cut_off_all();

  private:
    struct Open {
        bool idle = false;
    };

    const HttpLimits limits_;
    std::mutex mutex_;
    std::condition_variable closed_;
    std::map<int, Open> open_;
    std::map<std::string, size_t> per_address_;
    bool stopping_ = false;
};

}  // namespace coppice
