#include "core/base/parallel.h"

#include <algorithm>
#include <exception>
#include <limits>
#include <mutex>

#ifdef COPPICE_PARALLEL_STD
#include <atomic>
#include <thread>
#include <vector>
#else
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>
#endif

namespace coppice {

namespace {

#ifdef COPPICE_PARALLEL_STD
// For ThreadSanitizer: Debian's oneTBB is not instrumented, so that its hand-over of work looks like races.
void run(size_t count, unsigned threads, const std::function<void(size_t)>& body) {
    const size_t width = threads == 0 ? std::max(1U, std::thread::hardware_concurrency()) : threads;
    std::atomic<size_t> next = 0;
    std::vector<std::jthread> workers;
    for (size_t w = 0; w < std::min(width, count); ++w) {
        workers.emplace_back([&] {
            for (size_t i = next++; i < count; i = next++) body(i);
        });
    }
}
#else
void run(size_t count, unsigned threads, const std::function<void(size_t)>& body) {
    tbb::task_arena arena(threads == 0 ? tbb::task_arena::automatic : static_cast<int>(threads));
    // simple_partitioner: bodies are few and long, so each index is worth a task.
    arena.execute([&] { tbb::parallel_for(size_t{0}, count, body, tbb::simple_partitioner()); });
}
#endif

}  // namespace

void parallel_for(size_t count, unsigned threads, const std::function<void(size_t)>& body) {
    if (threads == 1 || count <= 1) {
        for (size_t i = 0; i < count; ++i) body(i);
        return;
    }
    std::mutex mutex;
    size_t failed = std::numeric_limits<size_t>::max();
    std::exception_ptr failure;
    run(count, threads, [&](size_t i) {
        try {
            body(i);
        } catch (...) {
            const std::scoped_lock lock(mutex);
            if (i < failed) {
                failed = i;
                failure = std::current_exception();
            }
        }
    });
    if (failure) std::rethrow_exception(failure);
}

}  // namespace coppice
