#include "server/telemetry/log.h"

#include <gtest/gtest.h>

namespace coppice {
namespace {

TEST(Log, quotes_what_json_needs_quoted) {
    EXPECT_EQ(quote_json("a\"b\\c"), R"("a\"b\\c")");
    EXPECT_EQ(quote_json("a\r\n\t\x01\x7f"), R"("a\u000d\u000a\u0009\u0001\u007f")");
    EXPECT_EQ(quote_json("größe €𝄞"), "\"größe €𝄞\"");
}

TEST(Log, replaces_what_is_not_utf8) {
    const std::string replaced = "\xef\xbf\xbd";
    EXPECT_EQ(quote_json("a\xff"), "\"a" + replaced + "\"");
    EXPECT_EQ(quote_json("\xc3"), "\"" + replaced + "\"");                                // cut short
    EXPECT_EQ(quote_json("\xc0\xaf"), "\"" + replaced + replaced + "\"");                 // overlong
    EXPECT_EQ(quote_json("\xed\xa0\x80"), "\"" + replaced + replaced + replaced + "\"");  // a surrogate
    EXPECT_EQ(quote_json("\xf4\x90\x80\x80"), "\"" + replaced + replaced + replaced + replaced + "\"");
}

}  // namespace
}  // namespace coppice
