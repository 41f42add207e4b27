// One connection: its requests, one after the other.
#pragma once

#include <atomic>
#include <string>

#include "server/http/connections.h"
#include "server/http/exchange.h"
#include "server/http/limits.h"
#include "server/http/message.h"
#include "server/http/router.h"

namespace coppice {

// What the connections of a server share.
struct Serving {
    Serving(Router router, const HttpLimits& limits, Observe observe);

    std::string next_request_id();

    const Router router;
    const HttpLimits limits;
    const Observe observe;
    Connections connections;

  private:
    const uint64_t process_;  // random: request ids of two processes differ
    std::atomic<uint64_t> requests_{0};
};

// Until the client ends it, or a limit or a fault does. The socket stays the caller's, to close. only_always:
// the server has as many connections as it takes, and routes that are not Route::always answer 503.
void serve_connection(Serving& serving, int socket, const std::string& address, bool only_always);

// An answer without content, after which the connection closes, as bytes.
std::string print_last_answer(const Response& response);

}  // namespace coppice
