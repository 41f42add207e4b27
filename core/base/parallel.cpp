#include "core/base/parallel.h"

#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include <exception>
#include <limits>
#include <mutex>

namespace coppice {

void parallel_for(size_t count, unsigned threads, const std::function<void(size_t)>& body) {
    if (threads == 1 || count <= 1) {
        for (size_t i = 0; i < count; ++i) body(i);
        return;
    }
    std::mutex mutex;
    size_t failed = std::numeric_limits<size_t>::max();
    std::exception_ptr failure;
    const int width = threads == 0 ? tbb::task_arena::automatic : static_cast<int>(threads);
    tbb::task_arena arena(width);
    arena.execute([&] {
        tbb::parallel_for(size_t{0}, count, [&](size_t i) {
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
    });
    if (failure) std::rethrow_exception(failure);
}

}  // namespace coppice
