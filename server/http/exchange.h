// One request and its answer, once it was sent, for logs and metrics.
#pragma once

#include <chrono>
#include <cstdint>
#include <functional>
#include <string>

namespace coppice {

struct Exchange {
    std::string request_id;
    std::string method;  // empty where the request could not be read, or was not: the connection was refused
    std::string path;
    std::string route;  // the pattern; empty where none matched
    std::string remote_address;
    std::string job;
    int status = 0;
    uint64_t bytes_in = 0;   // of the body
    uint64_t bytes_out = 0;  // of the body
    std::chrono::duration<double> time{0};
    std::string fault;   // what failed on our side; clients are not told all of it
    uint64_t count = 1;  // more: so many connections were refused alike, and this is the last of them
};

// Called from several threads at a time.
using Observe = std::function<void(const Exchange&)>;

}  // namespace coppice
