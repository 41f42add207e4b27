#include "core/base/watched_loop.h"

#include <gtest/gtest.h>

#include <vector>

#include "core/base/error.h"

namespace coppice {
namespace {

TEST(WatchedLoop, takes_every_index_once_in_order) {
    for (const size_t count : {size_t{0}, size_t{1}, watched_stride, 2 * watched_stride + 3}) {
        std::vector<size_t> taken;
        watched_loop(count, {}, [&](size_t i) { taken.push_back(i); });
        ASSERT_EQ(taken.size(), count);
        for (size_t i = 0; i < count; ++i) ASSERT_EQ(taken[i], i);
    }
}

TEST(WatchedLoop, goes_on_for_no_more_than_a_stride_after_a_stop) {
    std::stop_source stop;
    size_t taken = 0;
    EXPECT_THROW(watched_loop(100 * watched_stride, {.stop = stop.get_token()},
                              [&](size_t i) {
                                  ++taken;
                                  if (i == 10) stop.request_stop();
                              }),
                 Error);
    EXPECT_LE(taken, watched_stride);
}

TEST(WatchedLoop, does_nothing_when_it_is_stopped_before) {
    std::stop_source stop;
    stop.request_stop();
    EXPECT_THROW(watched_loop(5, {.stop = stop.get_token()}, [](size_t) { FAIL(); }), Error);
}

}  // namespace
}  // namespace coppice
