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

bool ConnectionThreads::run(std::function<void()> connection) {
    const std::scoped_lock lock(mutex_);
    if (waiting_.size() >= idle_ && !start_thread()) return false;
    waiting_.push_back(std::move(connection));
    ready_.notify_one();
    return true;
}

bool ConnectionThreads::start_thread() {
    if (threads_.size() >= most_) return false;
    try {
        threads_.emplace_back([this] { work(); });
        ++idle_;  // it will look for work as soon as it can
        return true;
    } catch (const std::system_error&) {  // the system gives no more of them
        return false;
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
