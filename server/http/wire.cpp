#include "server/http/wire.h"

#include <linux/sockios.h>
#include <poll.h>
#include <sys/ioctl.h>
#include <sys/socket.h>

#include <algorithm>
#include <array>
#include <cerrno>

#include "core/base/error.h"

namespace coppice {
namespace {

using Clock = std::chrono::steady_clock;

constexpr size_t receive_buffer_bytes = 16 << 10;
constexpr size_t send_buffer_bytes = 64 << 10;
constexpr int once_fast = 10;  // times as slow as at first
constexpr std::chrono::milliseconds look_every{1000};

}  // namespace

Patience::Duration Patience::left() const {
    return pace_.bytes_per_second == 0 ? total_left_ : std::min(total_left_, slow_left_);
}

void Patience::waited(Duration time) {
    total_left_ -= time;
    slow_left_ -= time;
}

void Patience::moved(uint64_t bytes) {
    if (pace_.bytes_per_second == 0) return;
    using Seconds = std::chrono::duration<double>;
    const Seconds earned(static_cast<double>(bytes) / static_cast<double>(pace_.bytes_per_second));
    const Seconds most = once_fast * pace_.slow_time;
    slow_left_ = std::chrono::duration_cast<Duration>(std::min<Seconds>(slow_left_ + earned, most));
}

Wire::Wire(int socket) : socket_(socket) {}

bool Wire::wait_for(short events, Patience& patience) {
    for (;;) {
        const auto left = std::chrono::ceil<std::chrono::milliseconds>(patience.left());
        if (left.count() <= 0) return false;
        pollfd waiting{socket_, events, 0};
        const auto begin = Clock::now();
        const int ready = ::poll(&waiting, 1, static_cast<int>(std::min(left, look_every).count()));
        patience.waited(Clock::now() - begin);
        if (events == POLLOUT) count_taken(patience);
        if (ready > 0) return true;
        if (ready < 0 && errno != EINTR) return true;  // the call that follows tells what is wrong
    }
}

void Wire::count_taken(Patience& patience) {
    int waiting = 0;
    if (::ioctl(socket_, SIOCOUTQ, &waiting) != 0) waiting = 0;
    const uint64_t taken = sent_ - std::min(sent_, static_cast<uint64_t>(waiting));
    if (taken > taken_) patience.moved(taken - taken_);
    taken_ = std::max(taken, taken_);
}

size_t Wire::receive(std::span<std::byte> into, Patience& patience) {
    for (;;) {
        const ssize_t got = ::recv(socket_, into.data(), into.size(), MSG_DONTWAIT);
        if (got > 0) {
            patience.moved(static_cast<size_t>(got));
            return static_cast<size_t>(got);
        }
        if (got == 0) return 0;
        if (errno == EINTR) continue;
        if (errno != EAGAIN && errno != EWOULDBLOCK) return 0;
        require(wait_for(POLLIN, patience), ErrorCode::request_timeout, "",
                "the request came too slowly; send at least http_bytes_per_second bytes a second, and all of "
                "it within "
                "http_body_ms");
    }
}

size_t Wire::read(std::span<std::byte> into, Patience& patience) {
    const size_t buffered = received_.size() - received_begin_;
    if (buffered == 0) {
        if (into.size() >= receive_buffer_bytes) return receive(into, patience);
        received_.resize(receive_buffer_bytes);
        received_begin_ = 0;
        size_t got = 0;
        try {
            got = receive(received_, patience);
        } catch (...) {
            received_.clear();
            throw;
        }
        received_.resize(got);
        if (got == 0) return 0;
    }
    const size_t taken = std::min(into.size(), received_.size() - received_begin_);
    std::copy_n(received_.begin() + static_cast<ptrdiff_t>(received_begin_), taken, into.begin());
    received_begin_ += taken;
    return taken;
}

std::string Wire::read_head(const HttpLimits& limits, std::chrono::milliseconds idle_time) {
    std::string head;
    std::array<std::byte, 1> next{};
    Patience before_first(idle_time);
    Patience patience(limits.header_time);
    for (;;) {
        size_t got = 0;
        try {
            got = read(next, head.empty() ? before_first : patience);
        } catch (const Error&) {
            if (head.empty()) return {};
            fail(ErrorCode::request_timeout, "headers",
                 fmt::format("the headers did not arrive within {} ms (http_header_ms)",
                             limits.header_time.count()));
        }
        if (got == 0) {
            require(head.empty(), ErrorCode::request_malformed, "headers",
                    "the connection ended within the headers");
            return {};
        }
        head += static_cast<char>(next[0]);
        if (next[0] != std::byte{'\n'}) {
            require(head.size() < limits.header_bytes, ErrorCode::request_malformed, "headers",
                    "the headers are longer than {} bytes (http_header_bytes)", limits.header_bytes);
            continue;
        }
        require(head.size() >= 2 && head[head.size() - 2] == '\r', ErrorCode::request_malformed, "headers",
                "a header line ends with a bare LF");
        if (head.ends_with("\r\n\r\n")) return head;
    }
}

bool Wire::write(std::string_view bytes, Patience& patience) {
    if (broken_) return false;
    if (unsent_.size() + bytes.size() < send_buffer_bytes) {
        unsent_ += bytes;
        return true;
    }
    return flush(patience) && send_all(bytes, patience);
}

bool Wire::flush(Patience& patience) {
    const std::string pending = std::exchange(unsent_, {});
    return !broken_ && send_all(pending, patience);
}

bool Wire::send_all(std::string_view bytes, Patience& patience) {
    while (!bytes.empty() && !broken_) {
        const ssize_t sent = ::send(socket_, bytes.data(), bytes.size(), MSG_DONTWAIT | MSG_NOSIGNAL);
        if (sent >= 0) {
            sent_ += static_cast<uint64_t>(sent);
            count_taken(patience);
            bytes.remove_prefix(static_cast<size_t>(sent));
        } else if (errno == EAGAIN || errno == EWOULDBLOCK) {
            broken_ = !wait_for(POLLOUT, patience);
        } else if (errno != EINTR) {
            broken_ = true;
        }
    }
    return !broken_;
}

bool Wire::is_gone() const {
    std::byte peeked{};
    const ssize_t got = ::recv(socket_, &peeked, 1, MSG_PEEK | MSG_DONTWAIT);
    return got == 0 || (got < 0 && errno != EAGAIN && errno != EWOULDBLOCK && errno != EINTR);
}

void Wire::linger(std::chrono::milliseconds at_most, uint64_t at_most_bytes) {
    ::shutdown(socket_, SHUT_WR);
    Patience patience(at_most);
    // A fast sender never makes us wait, and must not keep us either.
    const auto end = Clock::now() + at_most;
    std::array<std::byte, receive_buffer_bytes> swallowed{};
    uint64_t bytes = 0;
    try {
        while (Clock::now() < end && bytes < at_most_bytes) {
            const size_t got = receive(swallowed, patience);
            if (got == 0) break;
            bytes += got;
        }
    } catch (const Error&) {  // waited long enough
    }
}

}  // namespace coppice
