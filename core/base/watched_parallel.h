// Parallel loops that tell how far they are, and can be stopped.
#pragma once

#include <cstddef>
#include <functional>

#include "core/base/watch.h"

namespace coppice {

// parallel_for that looks at the watch before each item, and tells it the share of items done, in steps of at
// least 1 %. Items that take long have to look at the watch themselves.
void watched_parallel_for(size_t count, unsigned threads, const Watch& watch,
                          const std::function<void(size_t)>& body);

}  // namespace coppice
