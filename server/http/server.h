// The HTTP front: accepts connections, checks framing and limits, runs handlers, sends answers. A thread for
// each connection, up to the limit. Everything that clients see of errors is problem+json.
#pragma once

#include <chrono>
#include <cstdint>
#include <functional>
#include <memory>
#include <string>

#include "server/http/limits.h"
#include "server/http/router.h"

namespace coppice {

// One request and its answer, once it was sent, for logs and metrics.
struct Exchange {
    std::string request_id;
    std::string method;  // empty where the request could not be read
    std::string path;
    std::string route;  // the pattern; empty where none matched
    std::string remote_address;
    std::string job;
    int status = 0;
    uint64_t bytes_in = 0;   // of the body
    uint64_t bytes_out = 0;  // of the body
    std::chrono::duration<double> time{0};
    std::string internal_error;  // what() of an exception that the client is not told
};

class HttpServer {
  public:
    // observe is called from connection threads, several at a time.
    HttpServer(Router router, HttpLimits limits, std::function<void(const Exchange&)> observe);
    ~HttpServer();  // stop(0)
    HttpServer(const HttpServer&) = delete;
    HttpServer& operator=(const HttpServer&) = delete;

    // Binds, begins to answer on threads of its own, and returns the port (the chosen one where `port` is 0).
    // Throws Error{option_invalid} when the address cannot be bound.
    int start(const std::string& host, int port);

    // No new connections; idle ones are closed, requests that run may end within the grace, and are cut off
    // then.
    void stop(std::chrono::milliseconds grace);

  private:
    class Acceptor;
    std::unique_ptr<Acceptor> acceptor_;
};

}  // namespace coppice
