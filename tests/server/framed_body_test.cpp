#include "server/http/framed_body.h"

#include <gtest/gtest.h>

#include "tests/server/fails_with.h"

namespace coppice {
namespace {

using test::fails_with;

// Gives `bytes`, at most `step` at a time.
FramedBody::Source source(std::string bytes, size_t step = 3) {
    return [bytes = std::move(bytes), step, offset = size_t{0}](std::span<std::byte> into) mutable {
        const size_t given = std::min({into.size(), step, bytes.size() - offset});
        std::copy_n(as_bytes(bytes).begin() + static_cast<ptrdiff_t>(offset), given, into.begin());
        offset += given;
        return given;
    };
}

std::string read_all(Body& body) {
    Bytes all;
    Bytes some(5);
    while (const size_t got = body.read(some)) append(all, ByteView(some).first(got));
    return std::string(as_text(all));
}

FramedBody chunked(const std::string& bytes, uint64_t limit = 1000) {
    return FramedBody(source(bytes), true, 0, limit);
}

TEST(FramedBody, ends_after_its_length_whatever_follows) {
    FramedBody body(source("hello world, GET / HTTP/1.1"), false, 11, 1000);
    EXPECT_EQ(read_all(body), "hello world");
    EXPECT_TRUE(body.is_finished());
}

TEST(FramedBody, joins_chunks_and_skips_extensions_and_trailers) {
    FramedBody body = chunked("5;a=b\r\nhello\r\nA\r\n0123456789\r\n0\r\nX: y\r\n\r\nnext");
    EXPECT_EQ(read_all(body), "hello0123456789");
    EXPECT_TRUE(body.is_finished());
    EXPECT_EQ(body.bytes_read(), 15U);
}

TEST(FramedBody, a_body_that_is_cut_off_is_an_error) {
    FramedBody by_length(source("hel"), false, 5, 1000);
    EXPECT_THAT([&] { read_all(by_length); }, fails_with(ErrorCode::request_malformed, "after 3 bytes"));
    FramedBody by_chunks = chunked("5\r\nhel");
    EXPECT_THAT([&] { read_all(by_chunks); }, fails_with(ErrorCode::request_malformed, ""));
}

TEST(FramedBody, chunk_sizes_that_are_no_hexadecimal_numbers_are_refused) {
    for (const std::string size : {"-2", "+2", "0x2", "", "g", "2z", "10000000000000000"}) {
        FramedBody body = chunked(size + "\r\nab\r\n0\r\n\r\n");
        EXPECT_THAT([&] { read_all(body); }, fails_with(ErrorCode::request_malformed, "")) << size;
    }
}

TEST(FramedBody, junk_after_a_size_and_control_characters_are_refused) {
    for (const std::string bytes : {"4 junk=1\r\nabcd\r\n0\r\n\r\n", "4;a\rb\r\nabcd\r\n0\r\n\r\n",
                                    "4\r\nabcd\r\n0\r\nX: \x01\r\n\r\n"}) {
        FramedBody body = chunked(bytes);
        EXPECT_THAT([&] { read_all(body); }, fails_with(ErrorCode::request_malformed, "")) << bytes;
    }
}

TEST(FramedBody, a_chunk_longer_than_its_size_and_a_bare_line_feed_are_refused) {
    FramedBody longer = chunked("2\r\nabc\r\n0\r\n\r\n");
    EXPECT_THAT([&] { read_all(longer); }, fails_with(ErrorCode::request_malformed, ""));
    FramedBody bare = chunked("2\nab\r\n0\r\n\r\n");
    EXPECT_THAT([&] { read_all(bare); }, fails_with(ErrorCode::request_malformed, "bare LF"));
}

TEST(FramedBody, the_limit_holds_for_a_length_before_anything_is_read) {
    FramedBody body([](std::span<std::byte>) -> size_t { throw std::logic_error("it reads"); }, false, 11,
                    10);
    EXPECT_THAT([&] { read_all(body); }, fails_with(ErrorCode::request_too_large, "10 bytes"));
}

TEST(FramedBody, the_limit_holds_for_chunks_together) {
    FramedBody body = chunked("6\r\nabcdef\r\n6\r\nabcdef\r\n0\r\n\r\n", 10);
    EXPECT_THAT([&] { read_all(body); }, fails_with(ErrorCode::request_too_large, "upload_bytes"));
    FramedBody huge = chunked("ffffffffffffffff\r\n", 10);
    EXPECT_THAT([&] { read_all(huge); }, fails_with(ErrorCode::request_too_large, "upload_bytes"));
}

}  // namespace
}  // namespace coppice
