#include "core/base/watched_parallel.h"

#include <mutex>

#include "core/base/parallel.h"

namespace coppice {

void watched_parallel_for(size_t count, unsigned threads, const Watch& watch,
                          const std::function<void(size_t)>& body) {
    std::mutex mutex;
    size_t done = 0;
    double told = 0;
    parallel_for(count, threads, [&](size_t i) {
        watch.check();
        body(i);
        const std::scoped_lock lock(mutex);
        const double fraction = static_cast<double>(++done) / static_cast<double>(count);
        if (!watch.progress || fraction < told + 0.01) return;
        told = fraction;
        watch.progress(fraction);
    });
    watch.report(1);
}

}  // namespace coppice
