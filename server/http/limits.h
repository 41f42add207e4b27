// What one HTTP exchange may cost. Each is a setting that its refusal names, but for the last, which refuses
// nothing.
#pragma once

#include <chrono>
#include <cstddef>
#include <cstdint>

namespace coppice {

struct HttpLimits {
    size_t line_bytes = 8 << 10;     // request line, and each header line
    size_t header_bytes = 32 << 10;  // request line and all headers
    size_t headers = 100;
    uint64_t body_bytes = 512ULL << 20;
    size_t part_header_bytes = 4 << 10;  // of one multipart part
    size_t parts = 512;                  // multipart parts in one body

    std::chrono::milliseconds header_time{10'000};  // to the empty line; as long again before the first byte
    std::chrono::milliseconds body_time{900'000};   // for the whole body, however steadily it comes
    uint64_t bytes_per_second = 1000;               // both ways
    std::chrono::milliseconds slow_time{10'000};    // for so long, a client may be slower
    std::chrono::milliseconds idle_time{2'000};     // between two requests of a connection

    size_t connections = 512;
    size_t connections_per_address = 64;
    size_t requests_per_connection = 1000;
};

}  // namespace coppice
