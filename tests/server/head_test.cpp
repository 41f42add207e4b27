#include "server/http/head.h"

#include <gtest/gtest.h>

#include "tests/server/fails_with.h"

namespace coppice {
namespace {

using test::fails_with;

Head parse(const std::string& text) {
    return parse_head(text, HttpLimits{});
}

Head parse_with(const std::string& headers) {
    return parse("POST / HTTP/1.1\r\nHost: a\r\n" + headers + "\r\n");
}

TEST(Head, is_split_into_method_path_and_decoded_query) {
    const Head head = parse("GET /v1/jobs/a%20b?ratio=0.5&x=a%26b+c&flag HTTP/1.1\r\nHost: a\r\n\r\n");
    EXPECT_EQ(head.method, "GET");
    EXPECT_EQ(head.path, "/v1/jobs/a b");
    using Pairs = std::vector<std::pair<std::string, std::string>>;
    EXPECT_EQ(head.query, (Pairs{{"ratio", "0.5"}, {"x", "a&b c"}, {"flag", ""}}));
    EXPECT_TRUE(head.keep_alive);
    EXPECT_FALSE(head.has_body());
}

TEST(Head, names_are_found_in_lower_case_and_values_are_trimmed) {
    EXPECT_EQ(parse_with("PREFER: \t wait=3 \r\n").headers.find("prefer"), "wait=3");
}

TEST(Head, length_and_chunks_frame_the_body) {
    EXPECT_EQ(parse_with("Content-Length: 12\r\n").content_length, 12U);
    EXPECT_TRUE(parse_with("Transfer-Encoding: Chunked\r\n").chunked);
}

TEST(Head, connection_close_and_http_1_0_end_the_connection) {
    EXPECT_FALSE(parse_with("Connection: foo, Close\r\n").keep_alive);
    EXPECT_FALSE(parse("GET / HTTP/1.0\r\n\r\n").keep_alive);
}

TEST(Head, what_two_parsers_could_frame_differently_is_refused) {
    const std::vector<std::string> smuggled = {
        "Content-Length: 5\r\nTransfer-Encoding: chunked\r\n",
        "Content-Length: 5\r\nContent-Length: 6\r\n",
        "Content-Length: 5\r\nContent-Length: 5\r\n",
        "Content-Length: +5\r\n",
        "Content-Length: -5\r\n",
        "Content-Length: 5, 5\r\n",
        "Content-Length: 99999999999999999999999\r\n",
        "Content-Length:\r\n",
        "Transfer-Encoding: xchunked\r\n",
        "Transfer-Encoding: gzip, chunked\r\n",
        "Transfer-Encoding: chunked\r\nTransfer-Encoding: chunked\r\n",
        "Transfer-Encoding : chunked\r\n",
        " Transfer-Encoding: chunked\r\n",
        "X: a\rb\r\n",
        "X: a\nY: b\r\n",
        "no colon\r\n",
        "Host: twice\r\n",
    };
    for (const std::string& headers : smuggled) {
        EXPECT_THAT([&] { parse_with(headers); }, fails_with(ErrorCode::request_malformed, "")) << headers;
    }
}

TEST(Head, a_target_may_name_the_host_as_it_does_for_proxies) {
    const Head head = parse("GET HTTP://a:8080/v1/jobs?limit=1 HTTP/1.1\r\nHost: a\r\n\r\n");
    EXPECT_EQ(head.path, "/v1/jobs");
    EXPECT_EQ(head.query.at(0).first, "limit");
    EXPECT_EQ(parse("GET http://a HTTP/1.1\r\nHost: a\r\n\r\n").path, "/");
}

TEST(Head, a_request_line_that_is_not_one_is_refused) {
    for (const std::string line : {"GET", "GET /", "GET  HTTP/1.1", "G@T / HTTP/1.1", "GET / HTTP/2.0",
                                   "GET x HTTP/1.1", "GET /a b HTTP/1.1", "GET /# HTTP/1.1",
                                   "GET /%zz HTTP/1.1", "GET /%4 HTTP/1.1", "GET /%00 HTTP/1.1"}) {
        EXPECT_THAT([&] { parse(line + "\r\nHost: a\r\n\r\n"); },
                    fails_with(ErrorCode::request_malformed, ""))
            << line;
    }
}

TEST(Head, limits_are_named_where_they_refuse) {
    EXPECT_THAT([] { parse("GET /" + std::string(9000, 'a') + " HTTP/1.1\r\nHost: a\r\n\r\n"); },
                fails_with(ErrorCode::request_uri_too_long, "http_line_bytes"));
    EXPECT_THAT([] { parse_with("X: " + std::string(9000, 'a') + "\r\n"); },
                fails_with(ErrorCode::request_malformed, "http_line_bytes"));
    std::string many;
    for (int i = 0; i < 101; ++i) many += "X: a\r\n";
    EXPECT_THAT([&] { parse_with(many); }, fails_with(ErrorCode::request_malformed, "http_headers"));
}

TEST(Head, a_compressed_body_is_refused) {
    EXPECT_THAT([] { parse_with("Content-Encoding: gzip\r\n"); },
                fails_with(ErrorCode::request_encoding_unsupported, "gzip"));
}

}  // namespace
}  // namespace coppice
