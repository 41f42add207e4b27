// The HTTP layer by itself, byte by byte: framing, limits, slow clients, early answers.
#include "server/http/server.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <future>
#include <mutex>

#include "core/base/error.h"
#include "tests/server/http_client.h"

namespace coppice {
namespace {

using namespace std::chrono_literals;
using test::Answer;
using test::Connection;
using test::request;
using ::testing::HasSubstr;
using ::testing::StartsWith;

std::string read_all(Body& body) {
    Bytes all;
    Bytes some(1000);
    while (const size_t got = body.read(some)) append(all, ByteView(some).first(got));
    return std::string(as_text(all));
}

class HttpServerTest : public ::testing::Test {
  protected:
    HttpServerTest() {
        limits.body_bytes = 1 << 20;
        limits.header_time = 300ms;
        limits.idle_time = 300ms;
    }

    int start() {
        Router router;
        router.add({"GET", "/healthz", [](Request&, Response& response) { response.json(200, "{}"); }, true});
        router.add({"POST", "/echo",
                    [](Request& in, Response& response) { response.json(200, read_all(*in.body)); }});
        router.add({"POST", "/refuse", [](Request&, Response& response) {
                        response.set("Location", "/v1/jobs/1");
                        fail(ErrorCode::option_invalid, "ratio", "ratio is 7");
                    }});
        router.add({"GET", "/broken", [](Request&, Response&) { throw std::runtime_error("secret"); }});
        router.add({"GET", "/gate", [this](Request&, Response& response) {
                        entered.set_value();
                        gate.get_future().wait();
                        response.json(200, "\"through\"");
                    }});
        router.add({"GET", "/content", [](Request&, Response& response) {
                        response.content_type = "model/gltf-binary";
                        response.content = Content{3'000'000, [](uint64_t offset, std::span<std::byte> into) {
                                                       std::fill(into.begin(), into.end(),
                                                                 static_cast<std::byte>('a' + offset % 2));
                                                       return into.size();
                                                   }};
                    }});
        router.add({"GET", "/things/{id}/part",
                    [](Request& in, Response& response) { response.json(200, in.path_parameter("id")); }});
        server = std::make_unique<HttpServer>(std::move(router), limits, [this](const Exchange& exchange) {
            const std::scoped_lock lock(mutex);
            seen.push_back(exchange);
        });
        return server->start("127.0.0.1", 0);
    }

    HttpLimits limits;
    std::promise<void> entered;
    std::promise<void> gate;
    std::mutex mutex;
    std::vector<Exchange> seen;
    std::unique_ptr<HttpServer> server;
};

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
    EXPECT_EQ(request(port, "GET", "/content").body.size(), 3'000'000U);
    Connection connection(port);
    const Answer head = connection.request("HEAD", "/content");
    EXPECT_EQ(head.header("content-length"), "3000000");
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
    EXPECT_EQ(seen.at(0).internal_error, "secret");
}

TEST_F(HttpServerTest, a_body_over_the_limit_is_413_whether_its_length_is_told_or_not) {
    const int port = start();
    Connection told(port);
    told.send_bytes("POST /echo HTTP/1.1\r\nHost: a\r\nContent-Length: 1048577\r\n\r\n");
    EXPECT_EQ(told.receive().status, 413);
    Connection counted(port);
    counted.send_bytes("POST /echo HTTP/1.1\r\nHost: a\r\nTransfer-Encoding: chunked\r\n\r\n");
    for (int i = 0; i < 20; ++i) counted.send_bytes("10000\r\n" + std::string(65536, 'x') + "\r\n");
    const Answer answer = counted.receive();
    EXPECT_EQ(answer.status, 413);
    EXPECT_THAT(answer.body, HasSubstr("upload_bytes"));
    EXPECT_EQ(answer.header("connection"), "close");
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

TEST_F(HttpServerTest, a_uri_and_headers_over_their_limits_are_refused) {
    const int port = start();
    EXPECT_EQ(request(port, "GET", "/" + std::string(9000, 'a')).status, 414);
    EXPECT_EQ(request(port, "GET", "/healthz", {{"X", std::string(9000, 'a')}}).status, 400);
    test::HeaderList many(40, {"X", std::string(1000, 'a')});
    EXPECT_EQ(request(port, "GET", "/healthz", many).status, 400);
}

TEST_F(HttpServerTest, headers_that_drip_are_408_at_their_deadline_and_disturb_nobody) {
    const int port = start();
    std::vector<std::unique_ptr<Connection>> dripping;
    for (int i = 0; i < 30; ++i) {
        dripping.push_back(std::make_unique<Connection>(port));
        dripping.back()->send_bytes("GET /healthz HTTP/1.1\r\nHo");
    }
    EXPECT_EQ(request(port, "GET", "/healthz").status, 200);
    EXPECT_EQ(dripping.front()->receive().status, 408);
}

TEST_F(HttpServerTest, a_body_that_stops_is_408_at_its_deadline) {
    limits.body_time = 200ms;
    Connection connection(start());
    connection.send_bytes("POST /echo HTTP/1.1\r\nHost: a\r\nContent-Length: 10\r\n\r\nhalf");
    const Answer answer = connection.receive();
    EXPECT_EQ(answer.status, 408);
    EXPECT_THAT(answer.body, HasSubstr("request.timeout"));
}

TEST_F(HttpServerTest, an_idle_connection_is_closed_without_a_word) {
    Connection connection(start());
    connection.request("GET", "/healthz");
    EXPECT_TRUE(connection.is_closed_within(5000));
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

TEST_F(HttpServerTest, over_the_cap_of_connections_all_but_health_is_503) {
    limits.connections = 1;
    limits.header_time = 5s;
    const int port = start();
    Connection first(port);
    EXPECT_EQ(first.request("GET", "/healthz").status, 200);
    first.send_bytes("GET /hea");  // keeps it busy
    EXPECT_EQ(request(port, "GET", "/healthz").status, 200);
    const Answer refused = request(port, "POST", "/echo", {}, "x");
    EXPECT_EQ(refused.status, 503);
    EXPECT_FALSE(refused.header("retry-after").empty());
}

TEST_F(HttpServerTest, one_address_takes_only_its_share_of_connections) {
    limits.connections_per_address = 1;
    limits.header_time = 5s;
    const int port = start();
    Connection first(port);
    EXPECT_EQ(first.request("GET", "/healthz").status, 200);
    first.send_bytes("GET /hea");
    EXPECT_EQ(request(port, "POST", "/echo", {}, "x").status, 503);
}

TEST_F(HttpServerTest, stopping_lets_a_request_that_runs_end_and_closes_idle_connections) {
    const int port = start();
    Connection idle(port);
    idle.request("GET", "/healthz");
    Connection busy(port);
    busy.send_bytes("GET /gate HTTP/1.1\r\nHost: a\r\n\r\n");
    entered.get_future().wait();
    std::thread stopper([&] { server->stop(10s); });
    EXPECT_TRUE(idle.is_closed_within(5000));
    gate.set_value();
    EXPECT_EQ(busy.receive().body, "\"through\"");
    stopper.join();
    EXPECT_THROW(Connection{port}, std::runtime_error);
}

TEST_F(HttpServerTest, two_services_do_not_share_a_port) {
    const int port = start();
    HttpServer second({}, limits, {});
    EXPECT_THROW(second.start("127.0.0.1", port), Error);
}

}  // namespace
}  // namespace coppice
