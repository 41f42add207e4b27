#include "server/http/listener.h"

#include <netdb.h>
#include <netinet/in.h>
#include <poll.h>
#include <sys/socket.h>

#include <array>
#include <cerrno>
#include <memory>
#include <system_error>

#include "core/base/error.h"

namespace coppice {
namespace {

using namespace std::chrono_literals;

constexpr int backlog = 1024;
constexpr auto pause_after_failure = 20ms;

using Addresses = std::unique_ptr<addrinfo, decltype(&::freeaddrinfo)>;

// What would be right.
std::string_view advice(int number) {
    switch (number) {
        case EADDRINUSE:
            return "end what listens there, or take another port (--listen ADDRESS:PORT; port 0 takes a free "
                   "one)";
        case EACCES:
            return "take a port over 1023, or let the process bind lower ones";
        case EADDRNOTAVAIL:
            return "take an address of this machine, such as 127.0.0.1, or 0.0.0.0 for all of them";
        default:
            return "take another address or port (--listen ADDRESS:PORT)";
    }
}

[[noreturn]] void fail_to_listen(const std::string& host, int port, const std::string& why,
                                 std::string_view what_would_be_right) {
    fail(ErrorCode::internal, "listen",
         fmt::format("cannot listen on {}:{}: {}; {}", host, port, why, what_would_be_right));
}

Addresses resolve(const std::string& host, int port) {
    addrinfo wanted{};
    wanted.ai_flags = AI_PASSIVE | AI_NUMERICSERV;
    wanted.ai_socktype = SOCK_STREAM;
    addrinfo* found = nullptr;
    const int error = ::getaddrinfo(host.c_str(), std::to_string(port).c_str(), &wanted, &found);
    if (error != 0) fail_to_listen(host, port, ::gai_strerror(error), advice(EADDRNOTAVAIL));
    return {found, &::freeaddrinfo};
}

void set(int socket, int level, int option, int value) {
    ::setsockopt(socket, level, option, &value, sizeof value);
}

// Not open where it cannot be; errno says why.
Descriptor listen_on(const addrinfo& address) {
    Descriptor socket(::socket(address.ai_family, SOCK_STREAM | SOCK_CLOEXEC | SOCK_NONBLOCK, 0));
    if (!socket.is_open()) return socket;
    // Not SO_REUSEPORT: a second service on the port would silently share it.
    set(socket.number(), SOL_SOCKET, SO_REUSEADDR, 1);
    if (address.ai_family == AF_INET6) set(socket.number(), IPPROTO_IPV6, IPV6_V6ONLY, 0);
    if (::bind(socket.number(), address.ai_addr, address.ai_addrlen) == 0 &&
        ::listen(socket.number(), backlog) == 0) {
        return socket;
    }
    const int error = errno;
    socket = Descriptor();
    errno = error;
    return socket;
}

std::string digits_of(const sockaddr_storage& address, socklen_t bytes) {
    std::array<char, NI_MAXHOST> text{};
    const auto* general = reinterpret_cast<const sockaddr*>(&address);
    const int error =
        ::getnameinfo(general, bytes, text.data(), text.size(), nullptr, 0, NI_NUMERICHOST | NI_NUMERICSERV);
    return error == 0 ? text.data() : "";
}

int port_of(const Descriptor& socket) {
    sockaddr_storage address{};
    socklen_t bytes = sizeof address;
    ::getsockname(socket.number(), reinterpret_cast<sockaddr*>(&address), &bytes);
    return ntohs(address.ss_family == AF_INET6 ? reinterpret_cast<const sockaddr_in6&>(address).sin6_port
                                               : reinterpret_cast<const sockaddr_in&>(address).sin_port);
}

}  // namespace

Listener::Listener(const std::string& host, int port) {
    const Addresses addresses = resolve(host, port);
    for (const addrinfo* next = addresses.get(); next != nullptr && !socket_.is_open();
         next = next->ai_next) {
        socket_ = listen_on(*next);
    }
    if (!socket_.is_open()) {
        const int error = errno;
        fail_to_listen(host, port, std::generic_category().message(error), advice(error));
    }
    port_ = port_of(socket_);
}

std::optional<Accepted> Listener::accept(std::chrono::milliseconds at_most) {
    pollfd waiting{socket_.number(), POLLIN, 0};
    if (::poll(&waiting, 1, static_cast<int>(at_most.count())) <= 0 || stopped_) return std::nullopt;
    sockaddr_storage address{};
    socklen_t bytes = sizeof address;
    Descriptor socket(
        ::accept4(socket_.number(), reinterpret_cast<sockaddr*>(&address), &bytes, SOCK_CLOEXEC));
    if (socket.is_open()) return Accepted{std::move(socket), digits_of(address, bytes)};
    const bool is_gone = errno == EAGAIN || errno == EINTR || errno == ECONNABORTED;
    if (!is_gone) ::poll(nullptr, 0, static_cast<int>(pause_after_failure.count()));
    return std::nullopt;
}

void Listener::stop() {
    stopped_ = true;
    ::shutdown(socket_.number(), SHUT_RDWR);  // wakes accept
}

}  // namespace coppice
