// A page of memory that tells when somebody first touches it. So a test can act in the midst of what reads
// it, and see how far that came, without a clock.
#pragma once

#include <atomic>
#include <cstddef>
#include <functional>

#include "core/base/bytes.h"

namespace coppice::test {

// Two at most at the same time.
class TripWire {
  public:
    // At the first page that begins in the bytes at this offset or after it; the bytes have to own all of it.
    // on_touch runs in a signal handler, on the thread that touches: it may do little.
    TripWire(ByteView bytes, size_t offset, std::function<void()> on_touch = {});
    ~TripWire();
    TripWire(const TripWire&) = delete;
    TripWire& operator=(const TripWire&) = delete;

    bool was_touched() const { return touched_; }

    bool is_at(const void* address) const;
    void touch();

  private:
    std::byte* page_;
    std::function<void()> on_touch_;
    std::atomic<bool> touched_ = false;
};

}  // namespace coppice::test
