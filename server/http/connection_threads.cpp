#include "server/http/connection_threads.h"

#include <system_error>
#include <utility>

namespace coppice {

ConnectionThreads::~ConnectionThreads() {
    {
        const std::scoped_lock lock(mutex_);
        ending_ = true;
    }
    ready_.notify_all();
    for (std::thread& thread : threads_) thread.join();
}

ConnectionThreads::Outcome ConnectionThreads::run(std::function<void()> connection) {
    const std::scoped_lock lock(mutex_);
    if (waiting_.size() >= idle_) {
        if (const Outcome outcome = start_thread(); outcome != Outcome::runs) return outcome;
    }
    waiting_.push_back(std::move(connection));
    ready_.notify_one();
    return Outcome::runs;
}

ConnectionThreads::Outcome ConnectionThreads::start_thread() {
    if (threads_.size() >= most_) return Outcome::all_busy;
    try {
        threads_.emplace_back([this] { work(); });
        ++idle_;  // it will look for work as soon as it can
        return Outcome::runs;
    } catch (const std::system_error&) {
        return Outcome::no_thread;
    }
}

void ConnectionThreads::work() {
    std::unique_lock lock(mutex_);
    for (;;) {
        ready_.wait(lock, [&] { return ending_ || !waiting_.empty(); });
        if (waiting_.empty()) return;
        {
            const auto connection = std::move(waiting_.front());
            waiting_.pop_front();
            --idle_;
            lock.unlock();
            connection();
        }
        lock.lock();
        ++idle_;
    }
}

}  // namespace coppice
