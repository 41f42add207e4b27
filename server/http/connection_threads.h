// Threads for connections: made when they are first needed, and kept.
#pragma once

#include <condition_variable>
#include <deque>
#include <functional>
#include <mutex>
#include <thread>
#include <vector>

namespace coppice {

class ConnectionThreads {
  public:
    explicit ConnectionThreads(size_t most) : most_(most) {}
    ~ConnectionThreads();  // waits for what runs
    ConnectionThreads(const ConnectionThreads&) = delete;
    ConnectionThreads& operator=(const ConnectionThreads&) = delete;

    // What became of a connection: a thread runs it, all are busy and there may be no further one, or the
    // system gives no further one.
    enum class Outcome { runs, all_busy, no_thread };

    // `connection` throws nothing.
    Outcome run(std::function<void()> connection);

  private:
    Outcome start_thread();
    void work();

    const size_t most_;
    std::mutex mutex_;
    std::condition_variable ready_;
    std::deque<std::function<void()>> waiting_;
    std::vector<std::thread> threads_;
    size_t idle_ = 0;
    bool ending_ = false;
};

}  // namespace coppice
