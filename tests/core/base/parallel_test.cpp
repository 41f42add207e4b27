#include "core/base/parallel.h"

#include <gtest/gtest.h>

#include <atomic>
#include <stdexcept>
#include <string>
#include <vector>

namespace coppice {
namespace {

class ParallelFor : public testing::TestWithParam<unsigned> {};

TEST_P(ParallelFor, visits_every_index_once) {
    std::vector<std::atomic<int>> visits(1000);
    parallel_for(visits.size(), GetParam(), [&](size_t i) { ++visits[i]; });
    for (const auto& count : visits) EXPECT_EQ(count, 1);
}

TEST_P(ParallelFor, rethrows_what_a_body_throws) {
    EXPECT_THROW(parallel_for(100, GetParam(),
                              [](size_t i) {
                                  if (i == 37) throw std::runtime_error("37");
                              }),
                 std::runtime_error);
}

TEST_P(ParallelFor, does_nothing_for_nothing) {
    parallel_for(0, GetParam(), [](size_t) { FAIL() << "there is no item"; });
}

INSTANTIATE_TEST_SUITE_P(Threads, ParallelFor, testing::Values(0, 1, 2, 7));

}  // namespace
}  // namespace coppice
