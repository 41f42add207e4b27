#include "server/http/turned_away.h"

#include <sys/socket.h>

#include <algorithm>
#include <array>
#include <cerrno>

namespace coppice {
namespace {

using namespace std::chrono_literals;

constexpr size_t most_kept = 64;
constexpr auto moment = 1s;

// Takes what has come so far; true once the client has closed its side, or is gone.
bool has_ended(int socket) {
    std::array<char, 4096> swallowed{};
    for (int reads = 0; reads < 16; ++reads) {  // a fast sender must not keep us
        const ssize_t got = ::recv(socket, swallowed.data(), swallowed.size(), MSG_DONTWAIT);
        if (got == 0) return true;
        if (got < 0) return errno != EAGAIN && errno != EWOULDBLOCK && errno != EINTR;
    }
    return false;
}

}  // namespace

void TurnedAway::turn_away(Descriptor socket, std::string_view answer) {
    // It fits into the empty buffer of a new socket; where it does not, the client is no worse off than with
    // none.
    ::send(socket.number(), answer.data(), answer.size(), MSG_DONTWAIT | MSG_NOSIGNAL);
    ::shutdown(socket.number(), SHUT_WR);
    if (kept_.size() >= most_kept) kept_.pop_front();
    kept_.push_back({std::move(socket), Clock::now() + moment});
}

void TurnedAway::tidy(Clock::time_point now) {
    std::erase_if(kept_,
                  [&](const Kept& kept) { return kept.until <= now || has_ended(kept.socket.number()); });
}

}  // namespace coppice
