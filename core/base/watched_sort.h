// Sorting very many items in a way that can be stopped.
#pragma once

#include <algorithm>
#include <cstdint>

#include "core/base/watch.h"

namespace coppice {

// std::sort that looks at the watch once in 65536 comparisons, which take a few milliseconds. Where it
// throws, the items are in no particular order. `less` must have no ties, or items of equal ones in no order
// of their own, for the result to be the same everywhere.
template <typename Iterator, typename Less>
void watched_sort(Iterator begin, Iterator end, const Watch& watch, Less less) {
    uint32_t compared = 0;
    watch.check();
    std::sort(begin, end, [&](const auto& a, const auto& b) {
        if ((++compared & 0xFFFFU) == 0) watch.check();
        return less(a, b);
    });
}

}  // namespace coppice
