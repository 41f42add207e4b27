// Memory that runs out at a chosen moment: an executable's own operator new comes before the library's.
#pragma once

#include <cstddef>

namespace coppice::test {

// From now on, the n-th allocation of this thread (counted from 1) throws std::bad_alloc, and no other does.
void run_out_of_memory_at(size_t nth);

// Whether it came to that since; from now on, memory lasts.
bool has_run_out_of_memory();

}  // namespace coppice::test
