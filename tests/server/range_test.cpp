#include "server/http/range.h"

#include <gtest/gtest.h>

#include "tests/server/fails_with.h"

namespace coppice {
namespace {

TEST(Range, first_and_last_are_inclusive_and_end_with_the_bytes_there_are) {
    EXPECT_EQ(parse_range("bytes=2-4", 10)->first, 2U);
    EXPECT_EQ(parse_range("bytes=2-4", 10)->bytes(), 3U);
    EXPECT_EQ(parse_range("bytes=2-", 10)->bytes(), 8U);
    EXPECT_EQ(parse_range("bytes=2-99", 10)->last, 9U);
    EXPECT_EQ(parse_range("bytes=-3", 10)->first, 7U);
    EXPECT_EQ(parse_range("bytes=-30", 10)->bytes(), 10U);
}

TEST(Range, what_does_not_parse_is_as_if_it_were_not_there) {
    for (const char* text :
         {"lines=1-2", "bytes", "bytes=", "bytes=-", "bytes=a-b", "bytes=4-2", "bytes=1", "bytes=1-2x"}) {
        EXPECT_FALSE(parse_range(text, 10)) << text;
    }
}

TEST(Range, several_ranges_and_ranges_past_the_end_are_refused) {
    for (const char* text : {"bytes=0-1,3-4", "bytes=10-", "bytes=10-12", "bytes=-0"}) {
        EXPECT_THAT([&] { parse_range(text, 10); }, test::fails_with(ErrorCode::range_not_satisfiable, ""))
            << text;
    }
    EXPECT_THAT([] { parse_range("bytes=0-0", 0); }, test::fails_with(ErrorCode::range_not_satisfiable, ""));
}

}  // namespace
}  // namespace coppice
