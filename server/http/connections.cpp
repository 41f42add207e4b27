#include "server/http/connections.h"

#include <sys/socket.h>

namespace coppice {

Connections::Verdict Connections::open(int socket, const std::string& address) {
    const std::scoped_lock lock(mutex_);
    size_t& from_address = per_address_[address];
    if (from_address >= limits_.connections_per_address) return Verdict::too_many_from_address;
    open_[socket] = Open{};
    ++from_address;
    return open_.size() > limits_.connections ? Verdict::too_many : Verdict::welcome;
}

void Connections::close(int socket, const std::string& address) {
    const std::scoped_lock lock(mutex_);
    open_.erase(socket);
    if (const auto found = per_address_.find(address); found != per_address_.end() && --found->second == 0) {
        per_address_.erase(found);
    }
    closed_.notify_all();
}

bool Connections::begin_idle(int socket) {
    const std::scoped_lock lock(mutex_);
    open_[socket].idle = true;
    return !stopping_;
}

void Connections::end_idle(int socket) {
    const std::scoped_lock lock(mutex_);
    open_[socket].idle = false;
}

void Connections::stop_idle() {
    const std::scoped_lock lock(mutex_);
    stopping_ = true;
    for (const auto& [socket, state] : open_) {
        if (state.idle) ::shutdown(socket, SHUT_RD);
    }
}

bool Connections::is_stopping() {
    const std::scoped_lock lock(mutex_);
    return stopping_;
}

bool Connections::wait_until_empty(std::chrono::milliseconds at_most) {
    std::unique_lock lock(mutex_);
    return closed_.wait_for(lock, at_most, [&] { return open_.empty(); });
}

void Connections::cut_off_all() {
    const std::scoped_lock lock(mutex_);
    for (const auto& [socket, state] : open_) ::shutdown(socket, SHUT_RDWR);
}

}  // namespace coppice
