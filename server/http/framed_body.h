// A request's body off the wire: by its length, or chunk by chunk, counted against the limit as it comes.
#pragma once

#include <chrono>
#include <cstdint>
#include <functional>
#include <span>
#include <string>

#include "server/http/message.h"

namespace coppice {

class FramedBody final : public Body {
  public:
    // Bytes from the connection; 0: it ended. Throws request_timeout.
    using Source = std::function<size_t(std::span<std::byte>)>;

    FramedBody(Source source, bool chunked, uint64_t content_length, uint64_t limit_bytes);

    size_t read(std::span<std::byte> into) override;

    bool is_finished() const { return finished_; }  // nothing of it is left on the wire
    uint64_t bytes_read() const { return bytes_read_; }

  private:
    size_t read_some(std::span<std::byte> into);  // of the current chunk or length
    void next_chunk();
    std::string read_line();

    Source source_;
    bool chunked_;
    uint64_t left_;  // of the body, or of the current chunk
    uint64_t limit_bytes_;
    uint64_t bytes_read_ = 0;
    bool in_chunk_ = false;
    bool finished_ = false;
};

}  // namespace coppice
