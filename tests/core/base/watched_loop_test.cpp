#include "core/base/watched_loop.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <functional>
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

TEST(WatchedSteps, look_at_the_stop_by_what_was_done_not_by_items) {
    std::stop_source stop;
    WatchedSteps steps({.stop = stop.get_token()});
    stop.request_stop();
    for (size_t i = 1; i < watched_stride; ++i) steps.add(1);
    EXPECT_THROW(steps.add(1), Error);
    EXPECT_THROW(steps.add(1000 * watched_stride), Error);
}

TEST(WatchedSteps, can_stop_a_sort) {
    std::stop_source stop;
    stop.request_stop();
    WatchedSteps steps({.stop = stop.get_token()});
    std::vector<int> values(watched_stride + 1);
    EXPECT_THROW(std::sort(values.begin(), values.end(), steps.counting(std::less<>())), Error);
}

TEST(WatchedVectors, are_what_they_would_be_and_looked_after_once_in_few_bytes) {
    constexpr size_t count = 3 * watched_bytes / sizeof(double) + 1;
    size_t checks = 0;
    const Watch watch = {.checked = [&checks] { ++checks; }};
    const std::vector<double> values = watched_vector(count, watch, 1.5);
    EXPECT_EQ(values, std::vector<double>(count, 1.5));
    EXPECT_EQ(checks, 4U);
    EXPECT_EQ(watched_copy(values, watch), values);
    EXPECT_EQ(checks, 8U);
}

}  // namespace
}  // namespace coppice
