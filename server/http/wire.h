// The bytes of one connection, with a patience that ends: no client holds a thread by sending or reading
// slowly.
#pragma once

#include <chrono>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "core/base/bytes.h"
#include "server/http/limits.h"

namespace coppice {

// How long the other side may keep us waiting in one direction. Only time spent waiting counts, not our own
// work.
class Patience {
  public:
    using Duration = std::chrono::steady_clock::duration;

    // bytes_per_second 0: the total alone counts.
    Patience(Duration total, uint64_t bytes_per_second)
        : total_(total), bytes_per_second_(bytes_per_second) {}

    Duration left() const;
    void waited(Duration time) { waited_ += time; }
    void moved(size_t bytes) { bytes_ += bytes; }

  private:
    Duration total_;
    uint64_t bytes_per_second_;
    Duration waited_{0};
    uint64_t bytes_ = 0;
};

// Does not own the socket. One thread.
class Wire {
  public:
    explicit Wire(int socket);

    // The head of the next request, to its empty line; empty where the other side closed, or was idle for too
    // long, before its first byte. Throws request_malformed (too long, a bare LF) and request_timeout.
    std::string read_head(const HttpLimits& limits, std::chrono::milliseconds idle_time);

    // At least one byte, at most into.size(); 0: the other side closed. Throws request_timeout.
    size_t read(std::span<std::byte> into, Patience& patience);

    // Collects small writes; false once the other side is gone or too slow, and for ever after.
    bool write(std::string_view bytes, Patience& patience);
    bool flush(Patience& patience);

    bool is_gone() const;  // the other side closed or reset
    void linger(std::chrono::milliseconds
                    at_most);  // no more answers; swallows what still comes, so that ours arrives

  private:
    bool wait_for(short events, Patience& patience) const;
    size_t receive(std::span<std::byte> into, Patience& patience);
    bool send_all(std::string_view bytes, Patience& patience);

    int socket_;
    std::vector<std::byte> received_;  // read ahead, from received_begin_
    size_t received_begin_ = 0;
    std::string unsent_;
    bool broken_ = false;
};

}  // namespace coppice
