// How long a slow client may keep a thread, by the clock of the time that it made us wait.
#include <gtest/gtest.h>

#include "server/http/wire.h"

namespace coppice {
namespace {

using namespace std::chrono_literals;

constexpr Pace a_thousand_a_second{1000, 10s};

TEST(Patience, without_a_pace_ends_with_its_total) {
    Patience patience(5s);
    patience.waited(3s);
    patience.moved(1'000'000);
    EXPECT_EQ(patience.left(), 2s);
}

TEST(Patience, lets_a_client_be_slower_for_a_while) {
    Patience patience(1h, a_thousand_a_second);
    EXPECT_EQ(patience.left(), 10s);
    patience.waited(10s);
    EXPECT_LE(patience.left(), 0s);
}

TEST(Patience, lasts_as_long_as_the_pace_is_kept) {
    Patience patience(24h, a_thousand_a_second);
    for (int i = 0; i < 10'000; ++i) {
        patience.waited(1s);
        patience.moved(1000);
        ASSERT_GT(patience.left(), 0s) << i;
    }
}

TEST(Patience, ends_for_a_byte_a_second) {
    Patience patience(24h, a_thousand_a_second);
    int seconds = 0;
    for (; patience.left() > 0s && seconds < 1000; ++seconds) {
        patience.waited(1s);
        patience.moved(1);
    }
    EXPECT_EQ(seconds, 11);
}

TEST(Patience, of_a_client_that_was_fast_is_longer_but_not_as_long_as_it_was_fast) {
    Patience patience(24h, a_thousand_a_second);
    patience.moved(500'000'000);  // what would last for six days
    EXPECT_EQ(patience.left(), 100s);
}

TEST(Patience, never_outlasts_its_total) {
    Patience patience(20s, a_thousand_a_second);
    patience.moved(500'000'000);
    EXPECT_EQ(patience.left(), 20s);
}

}  // namespace
}  // namespace coppice
