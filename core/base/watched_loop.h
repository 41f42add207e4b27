// A loop over very many items that can be stopped.
#pragma once

#include <algorithm>
#include <cstddef>

#include "core/base/watch.h"

namespace coppice {

// Items between two looks at the watch: a few milliseconds where an item is a triangle or a wedge.
inline constexpr size_t watched_stride = size_t{1} << 14;

// Calls body(i) for 0..count-1 in order, and watch.check() before the first and then once in a stride.
template <typename Body>
void watched_loop(size_t count, const Watch& watch, Body&& body) {
    watch.check();
    for (size_t begin = 0; begin < count;) {
        const size_t end = std::min(count, begin + watched_stride);
        for (size_t i = begin; i < end; ++i) body(i);
        begin = end;
        watch.check();
    }
}

}  // namespace coppice
