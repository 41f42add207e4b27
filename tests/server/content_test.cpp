#include "server/http/content.h"

#include <gtest/gtest.h>

#include "core/base/bytes.h"

namespace coppice {
namespace {

// As a connection reads it: `step` bytes at a time.
std::string read_all(const Content& content, size_t step) {
    std::string all;
    Bytes some(step);
    while (const size_t got = content.read(all.size(), some)) all += as_text(ByteView(some).first(got));
    EXPECT_EQ(all.size(), content.bytes);
    return all;
}

TEST(Content, of_a_text_is_the_text) {
    for (const size_t step : {1U, 4U, 100U}) EXPECT_EQ(read_all(content_of("hello"), step), "hello");
    EXPECT_EQ(read_all(content_of(""), 4), "");
}

TEST(Content, that_is_joined_comes_one_after_the_other_however_it_is_read) {
    const Content joined =
        join({content_of("{\"id\":1,\"report\":"), content_of(""), content_of("{}"), content_of("}")});
    for (const size_t step : {1U, 3U, 17U, 18U, 19U, 100U}) {
        EXPECT_EQ(read_all(joined, step), "{\"id\":1,\"report\":{}}") << step;
    }
    EXPECT_EQ(read_all(join({}), 4), "");
}

TEST(Content, that_is_a_part_ends_where_the_part_does) {
    const Content part = part_of(join({content_of("0123"), content_of("456789")}), {2, 6});
    for (const size_t step : {1U, 2U, 5U, 100U}) EXPECT_EQ(read_all(part, step), "23456") << step;
}

TEST(Content, that_is_shorter_than_it_said_ends_what_it_is_joined_into) {
    const Content cut{5, [](uint64_t offset, std::span<std::byte>) -> size_t { return offset == 0 ? 1 : 0; }};
    Bytes into(20);
    EXPECT_EQ(join({content_of("ab"), cut, content_of("cd")}).read(0, into), 3U);
}

}  // namespace
}  // namespace coppice
