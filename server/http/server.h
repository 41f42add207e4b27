// The HTTP front: accepts connections, checks framing and limits, runs handlers, sends answers. A thread for
// each connection, up to the limit. Everything that clients see of errors is problem+json.
#pragma once

#include <chrono>
#include <memory>
#include <string>

#include "server/http/exchange.h"
#include "server/http/limits.h"
#include "server/http/router.h"

namespace coppice {

class HttpServer {
  public:
    HttpServer(Router router, const HttpLimits& limits, Observe observe);
    ~HttpServer();  // stop(0)
    HttpServer(const HttpServer&) = delete;
    HttpServer& operator=(const HttpServer&) = delete;

    // Binds, begins to answer on threads of its own, and returns the port (the chosen one where `port` is 0).
    // Throws as Listener does when the address cannot be bound.
    int start(const std::string& host, int port);

    // No new connections; idle ones are closed, requests that run may end within the grace, and are cut off
    // then.
    void stop(std::chrono::milliseconds grace);

  private:
    class Front;
    std::unique_ptr<Front> front_;
};

}  // namespace coppice
