#include "core/base/number.h"

#include <gtest/gtest.h>

namespace coppice {
namespace {

TEST(Number, is_a_decimal_number_and_nothing_else) {
    EXPECT_EQ(parse_number("0.5"), 0.5);
    EXPECT_EQ(parse_number("5e-1"), 0.5);
    EXPECT_EQ(parse_number("-3"), -3);
    for (const char* text : {"", "abc", "0.5x", " 0.5", "0.5 ", "0,5", "+0.5", "0x1p3", "inf", "-inf", "nan",
                             "NaN", "infinity", "1e999", "1_000", "--1"}) {
        EXPECT_FALSE(parse_number(text)) << text;
    }
}

TEST(Number, that_is_whole_has_digits_and_nothing_else) {
    EXPECT_EQ(parse_whole_number("0"), 0U);
    EXPECT_EQ(parse_whole_number("007"), 7U);
    EXPECT_EQ(parse_whole_number("18446744073709551615"), UINT64_MAX);
    EXPECT_EQ(parse_whole_number("5", 5, 6), 5U);
    EXPECT_EQ(parse_whole_number("6", 5, 6), 6U);
    EXPECT_FALSE(parse_whole_number("4", 5, 6));
    EXPECT_FALSE(parse_whole_number("7", 5, 6));
    for (const char* text : {"", "-1", "+1", " 1", "1 ", "1.0", "1e3", "0x1", "18446744073709551616"}) {
        EXPECT_FALSE(parse_whole_number(text)) << text;
    }
}

}  // namespace
}  // namespace coppice
