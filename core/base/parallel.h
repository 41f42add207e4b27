// Parallel loops over independent items. The only place in core that starts threads.
#pragma once

#include <cstddef>
#include <functional>

namespace coppice {

// Calls body(i) for every i in [0, count) on at most `threads` threads (0: one per core) and returns when all
// are done. Items must not depend on each other; what they write goes to places of their own, so that the
// result is the same for any thread count. Where bodies throw, the exception of the lowest index that was
// reached is rethrown.
void parallel_for(size_t count, unsigned threads, const std::function<void(size_t)>& body);

}  // namespace coppice
