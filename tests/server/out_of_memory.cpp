#include "tests/server/out_of_memory.h"

#include <cstdlib>
#include <new>

namespace coppice::test {
namespace {

thread_local size_t left = 0;  // allocations to the one that fails; 0: none does
thread_local bool happened = false;

bool fails_now() {
    if (left == 0 || --left > 0) return false;
    happened = true;
    return true;
}

}  // namespace

void run_out_of_memory_at(size_t nth) {
    happened = false;
    left = nth;
}

bool has_run_out_of_memory() {
    left = 0;
    return happened;
}

}  // namespace coppice::test

void* operator new(std::size_t bytes) {
    void* const memory = coppice::test::fails_now() ? nullptr : std::malloc(bytes == 0 ? 1 : bytes);
    if (memory == nullptr) throw std::bad_alloc();
    return memory;
}

void operator delete(void* memory) noexcept {
    std::free(memory);
}

void operator delete(void* memory, std::size_t /*bytes*/) noexcept {
    std::free(memory);
}
