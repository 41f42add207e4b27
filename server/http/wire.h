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

// How slow the other side may be. It may fall behind for slow_time at first, and for ten times that once it
// was fast: what it has taken an hour ago does not entitle it to an hour.
struct Pace {
    uint64_t bytes_per_second = 0;  // 0: any
    std::chrono::milliseconds slow_time{0};
};

// How long the other side may keep us waiting in one direction. Only time spent waiting counts, not our own
// work.
class Patience {
  public:
    using Duration = std::chrono::steady_clock::duration;

    explicit Patience(Duration total, Pace pace = {})
        : pace_(pace), total_left_(total), slow_left_(pace.slow_time) {}

    Duration left() const;
    void waited(Duration time);
    void moved(uint64_t bytes);

  private:
    Pace pace_;
    Duration total_left_;
    Duration slow_left_;
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

    // Collects small writes; false once the other side is gone or too slow, and for ever after. What counts
    // is what the other side has taken, not what waits in the system's buffers.
    bool write(std::string_view bytes, Patience& patience);
    bool flush(Patience& patience);

    bool is_gone() const;  // the other side closed or reset
    // No more answers. Swallows what still comes, since closing on it would reset the connection, and what
    // the other side has not taken yet would be lost; until that side closes too, or has had this time or
    // sent this much.
    void linger(std::chrono::milliseconds at_most, uint64_t at_most_bytes);

  private:
    bool wait_for(short events, Patience& patience);
    void count_taken(Patience& patience);
    size_t receive(std::span<std::byte> into, Patience& patience);
    bool send_all(std::string_view bytes, Patience& patience);

    int socket_;
    std::vector<std::byte> received_;  // read ahead, from received_begin_
    size_t received_begin_ = 0;
    std::string unsent_;
    uint64_t sent_ = 0;   // to the system
    uint64_t taken_ = 0;  // of it, by the other side
    bool broken_ = false;
};

}  // namespace coppice
