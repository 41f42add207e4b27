#include "tests/heap/heap_use.h"

#include <malloc.h>

#include <algorithm>
#include <atomic>
#include <cstdint>
#include <cstdlib>
#include <new>

#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
#define COPPICE_COUNTS_HEAP 0
#else
#define COPPICE_COUNTS_HEAP 1
#endif

namespace coppice::test {

namespace {

// What was there before may be freed while counting: less than nothing is in use then.
std::atomic<bool> is_counting = false;
std::atomic<int64_t> in_use = 0, most_in_use = 0;

}  // namespace

HeapUse::HeapUse() {
    in_use = 0;
    most_in_use = 0;
    is_counting = true;
}

HeapUse::~HeapUse() {
    is_counting = false;
}

size_t HeapUse::peak_bytes() const {
    return static_cast<size_t>(most_in_use.load());
}

bool HeapUse::is_counted() {
    return COPPICE_COUNTS_HEAP != 0;
}

#if COPPICE_COUNTS_HEAP

namespace {

void count_block(void* block, int64_t sign) {
    if (!is_counting.load(std::memory_order_relaxed)) return;
    const int64_t now = in_use += sign * static_cast<int64_t>(malloc_usable_size(block));
    int64_t most = most_in_use.load();
    while (now > most && !most_in_use.compare_exchange_weak(most, now)) {
    }
}

}  // namespace

#endif

}  // namespace coppice::test

#if COPPICE_COUNTS_HEAP

// The forms for arrays and those that do not throw end up here.
void* operator new(size_t size) {
    void* const block = std::malloc(std::max<size_t>(size, 1));
    if (block == nullptr) throw std::bad_alloc();
    coppice::test::count_block(block, 1);
    return block;
}

void operator delete(void* block) noexcept {
    coppice::test::count_block(block, -1);
    std::free(block);
}

void operator delete(void* block, size_t) noexcept {
    operator delete(block);
}

#endif
