// How much memory a piece of work takes at its peak. Programs that link heap_use.cpp have its operator new.
#pragma once

#include <cstddef>

namespace coppice::test {

// Counts what operator new hands out, over all threads, from its construction on. One at a time.
class HeapUse {
  public:
    HeapUse();
    ~HeapUse();
    HeapUse(const HeapUse&) = delete;
    HeapUse& operator=(const HeapUse&) = delete;

    // The most that was in use at one time, beyond what was when the counting began. As the allocator rounds
    // it; without what is aligned more strictly than operator new does by itself.
    size_t peak_bytes() const;

    // Not under sanitizers, which have allocators of their own.
    static bool is_counted();
};

}  // namespace coppice::test
