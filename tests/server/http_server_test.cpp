// The HTTP layer by itself, byte by byte: framing, early answers, and how it ends.
#include <thread>

#include "tests/server/fails_with.h"
#include "tests/server/http_server_fixture.h"

namespace coppice::test {
namespace {

using ::testing::HasSubstr;
using ::testing::StartsWith;

TEST_F(HttpServerTest, a_body_goes_in_and_an_answer_comes_out) {
    const int port = start();
    const Answer answer = request(port, "POST", "/echo", {{"X-Request-Id", "mine-1"}}, "hello");
    EXPECT_EQ(answer.status, 200);
    EXPECT_EQ(answer.body, "hello");
    EXPECT_EQ(answer.header("x-request-id"), "mine-1");
    EXPECT_EQ(answer.header("x-content-type-options"), "nosniff");
    EXPECT_FALSE(answer.header("date").empty());
    server->stop(1s);
    ASSERT_EQ(seen.size(), 1U);
    EXPECT_EQ(seen[0].route, "/echo");
    EXPECT_EQ(seen[0].bytes_in, 5U);
    EXPECT_EQ(seen[0].bytes_out, 5U);
}

TEST_F(HttpServerTest, one_connection_serves_many_requests) {
    Connection connection(start());
    for (int i = 0; i < 50; ++i) {
        EXPECT_EQ(connection.request("POST", "/echo", {}, std::to_string(i)).body, std::to_string(i));
    }
}

TEST_F(HttpServerTest, requests_that_come_together_are_answered_in_order) {
    Connection connection(start());
    connection.send_bytes(
        "POST /echo HTTP/1.1\r\nHost: a\r\nContent-Length: 3\r\n\r\none"
        "POST /echo HTTP/1.1\r\nHost: a\r\nTransfer-Encoding: chunked\r\n\r\n3\r\ntwo\r\n0\r\n\r\n"
        "GET /healthz HTTP/1.1\r\nHost: a\r\n\r\n");
    EXPECT_EQ(connection.receive().body, "one");
    EXPECT_EQ(connection.receive().body, "two");
    EXPECT_EQ(connection.receive().body, "{}");
}

TEST_F(HttpServerTest, content_is_streamed_whole_and_head_sends_none_of_it) {
    const int port = start();
    EXPECT_EQ(request(port, "GET", "/content").body.size(), content_bytes);
    Connection connection(port);
    const Answer head = connection.request("HEAD", "/content");
    EXPECT_EQ(head.header("content-length"), std::to_string(content_bytes));
    EXPECT_EQ(connection.request("GET", "/healthz").body, "{}");
}

TEST_F(HttpServerTest, path_parameters_are_segments) {
    const int port = start();
    EXPECT_EQ(request(port, "GET", "/things/a%2Fb/part").status, 404);
    EXPECT_EQ(request(port, "GET", "/things/ab/part").body, "ab");
    EXPECT_EQ(request(port, "GET", "/things//part").status, 404);
}

TEST_F(HttpServerTest, an_unknown_path_is_404_and_a_wrong_method_405_with_what_is_allowed) {
    const int port = start();
    const Answer unknown = request(port, "GET", "/nope");
    EXPECT_EQ(unknown.status, 404);
    EXPECT_EQ(unknown.header("content-type"), "application/problem+json");
    EXPECT_THAT(unknown.body, HasSubstr("route.not_found"));
    const Answer wrong = request(port, "DELETE", "/healthz");
    EXPECT_EQ(wrong.status, 405);
    EXPECT_EQ(wrong.header("allow"), "GET, HEAD");
    EXPECT_THAT(wrong.body, HasSubstr("method.not_allowed"));
}

TEST_F(HttpServerTest, an_error_is_a_problem_that_keeps_the_headers_set_before) {
    const Answer answer = request(start(), "POST", "/refuse", {}, "{}");
    EXPECT_EQ(answer.status, 400);
    EXPECT_EQ(answer.header("location"), "/v1/jobs/1");
    EXPECT_THAT(answer.body, HasSubstr("ratio is 7"));
}

TEST_F(HttpServerTest, what_an_exception_says_goes_to_the_log_and_not_to_the_client) {
    const Answer answer = request(start(), "GET", "/broken", {{"X-Request-Id", "r-77"}});
    EXPECT_EQ(answer.status, 500);
    EXPECT_THAT(answer.body, HasSubstr("r-77"));
    EXPECT_EQ(answer.body.find("secret"), std::string::npos);
    for (const auto& [name, value] : answer.headers)
        EXPECT_EQ(value.find("secret"), std::string::npos) << name;
    server->stop(1s);
    EXPECT_EQ(seen.at(0).fault, "secret");
}

TEST_F(HttpServerTest, what_is_left_of_a_body_after_an_early_answer_never_becomes_a_request) {
    Connection connection(start());
    const std::string smuggled = "GET /healthz HTTP/1.1\r\nHost: a\r\n\r\n";
    connection.send_bytes("POST /refuse HTTP/1.1\r\nHost: a\r\nContent-Length: " +
                          std::to_string(smuggled.size()) + "\r\n\r\n" + smuggled);
    EXPECT_EQ(connection.receive().status, 400);
    EXPECT_EQ(connection.receive().status, 0);
}

TEST_F(HttpServerTest, ambiguous_framing_is_400_and_the_end_of_the_connection) {
    const int port = start();
    for (const std::string headers :
         {"Content-Length: 4\r\nTransfer-Encoding: chunked\r\n", "Content-Length: 4\r\nContent-Length: 4\r\n",
          "Transfer-Encoding: chunked, chunked\r\n", "Content-Length: 4\n", " folded: x\r\n"}) {
        Connection connection(port);
        connection.send_bytes("POST /echo HTTP/1.1\r\nHost: a\r\n" + headers +
                              "\r\n0\r\n\r\nGET /healthz HTTP/1.1\r\n\r\n");
        const Answer answer = connection.receive();
        EXPECT_EQ(answer.status, 400) << headers;
        EXPECT_EQ(answer.header("connection"), "close");
        EXPECT_THAT(answer.body, HasSubstr("request.malformed"));
        EXPECT_EQ(connection.receive().status, 0) << headers;
    }
}

TEST_F(HttpServerTest, a_negative_chunk_size_is_400_at_once) {
    Connection connection(start());
    connection.send_bytes("POST /echo HTTP/1.1\r\nHost: a\r\nTransfer-Encoding: chunked\r\n\r\n-2\r\nab\r\n");
    EXPECT_EQ(connection.receive().status, 400);
    EXPECT_EQ(connection.receive().status, 0);
}

TEST_F(HttpServerTest, a_compressed_body_is_415) {
    EXPECT_EQ(request(start(), "POST", "/echo", {{"Content-Encoding", "gzip"}}, "x").status, 415);
}

TEST_F(HttpServerTest, expect_100_continue_is_told_only_when_the_body_is_wanted) {
    const int port = start();
    Connection wanted(port);
    wanted.send_bytes(
        "POST /echo HTTP/1.1\r\nHost: a\r\nExpect: 100-continue\r\nContent-Length: 2\r\n\r\nhi");
    EXPECT_THAT(wanted.receive().body, "hi");
    Connection refused(port);
    refused.send_bytes(
        "POST /refuse HTTP/1.1\r\nHost: a\r\nExpect: 100-continue\r\nContent-Length: 2\r\n\r\n");
    EXPECT_THAT(refused.receive_until_closed(), StartsWith("HTTP/1.1 400"));
}

TEST_F(HttpServerTest, content_that_fails_while_it_is_sent_ends_the_connection_and_goes_to_the_log) {
    const int port = start();
    const Answer cut = request(port, "GET", "/failing");
    EXPECT_EQ(cut.status, 200);
    EXPECT_LT(cut.body.size(), 1'000'000U);
    server->stop(1s);
    ASSERT_EQ(seen.size(), 1U);
    EXPECT_EQ(seen[0].fault, "the disk is broken");
    EXPECT_EQ(seen[0].bytes_out, cut.body.size());
}

TEST_F(HttpServerTest, after_an_answer_that_broke_off_no_other_is_taken_for_its_end) {
    Connection connection(start());
    connection.send_bytes(
        "GET /failing HTTP/1.1\r\nHost: a\r\n\r\n"
        "GET /healthz HTTP/1.1\r\nHost: a\r\n\r\n");
    const std::string all = connection.receive_until_closed();
    EXPECT_THAT(all, StartsWith("HTTP/1.1 200 OK\r\n"));
    EXPECT_EQ(all.rfind("HTTP/1.1"), 0U);
    server->stop(1s);
    EXPECT_EQ(seen.size(), 1U);
}

TEST_F(HttpServerTest, the_last_answer_arrives_whole_whatever_was_sent_behind_its_request) {
    Connection connection(start());
    std::string pipelined = "GET /content HTTP/1.1\r\nHost: a\r\nConnection: close\r\n\r\n";
    while (pipelined.size() < 100'000) pipelined += "GET /healthz HTTP/1.1\r\nHost: a\r\n\r\n";
    connection.send_bytes(pipelined);
    const Answer answer = connection.receive();
    EXPECT_EQ(answer.header("connection"), "close");
    EXPECT_EQ(answer.body.size(), content_bytes);
    EXPECT_EQ(connection.receive_until_closed(), "");
}

TEST_F(HttpServerTest, ranges_are_promised_only_where_they_are_served) {
    Connection connection(start());
    EXPECT_EQ(connection.request("HEAD", "/healthz").header("accept-ranges"), "");
}

TEST_F(HttpServerTest, stopping_lets_a_request_that_runs_end_and_closes_idle_connections) {
    const int port = start();
    Connection idle(port);
    idle.request("GET", "/healthz");
    Connection busy(port);
    busy.send_bytes("GET /gate HTTP/1.1\r\nHost: a\r\n\r\n");
    entered.get_future().wait();
    std::thread stopper([&] { server->stop(10s); });
    EXPECT_EQ(idle.receive_until_closed(), "");
    gate.set_value();
    EXPECT_EQ(busy.receive().body, "\"through\"");
    stopper.join();
    EXPECT_THROW(Connection{port}, std::runtime_error);
}

TEST_F(HttpServerTest, stopping_does_not_blame_a_client_that_is_still_sending_its_headers) {
    limits.header_time = 20s;
    Connection half(start());
    half.request("GET", "/healthz");
    half.send_bytes("GET /hea");
    server->stop(10s);
    const Answer answer = half.receive();
    if (answer.status == 0) return;  // nothing of it was read yet: closed, as an idle connection is
    EXPECT_EQ(answer.status, 503);
    EXPECT_THAT(answer.body, HasSubstr("service.draining"));
}

TEST_F(HttpServerTest, two_services_do_not_share_a_port) {
    const int port = start();
    HttpServer second({}, limits, {});
    EXPECT_THAT([&] { second.start("127.0.0.1", port); },
                fails_with(ErrorCode::internal, "127.0.0.1:" + std::to_string(port) +
                                                    ": Address already in use; end what listens there"));
}

}  // namespace
}  // namespace coppice::test
