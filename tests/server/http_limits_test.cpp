// What one client may cost: sizes, times, connections. And what happens where the system has nothing left.
#include <sys/resource.h>

#include <algorithm>
#include <cerrno>
#include <filesystem>
#include <utility>

#include "tests/server/failing_calls.h"
#include "tests/server/http_server_fixture.h"
#include "tests/server/plain_user.h"

namespace coppice::test {
namespace {

using ::testing::HasSubstr;

class HttpServerLimits : public HttpServerTest {};

TEST_F(HttpServerLimits, a_body_over_the_limit_is_413_whether_its_length_is_told_or_not) {
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

TEST_F(HttpServerLimits, a_uri_and_headers_over_their_limits_are_refused) {
    const int port = start();
    EXPECT_EQ(request(port, "GET", "/" + std::string(9000, 'a')).status, 414);
    EXPECT_EQ(request(port, "GET", "/healthz", {{"X", std::string(9000, 'a')}}).status, 400);
    HeaderList many(40, {"X", std::string(1000, 'a')});
    EXPECT_EQ(request(port, "GET", "/healthz", many).status, 400);
}

TEST_F(HttpServerLimits, headers_that_drip_are_408_at_their_deadline_and_disturb_nobody) {
    const int port = start();
    std::vector<std::unique_ptr<Connection>> dripping;
    for (int i = 0; i < 30; ++i) {
        dripping.push_back(std::make_unique<Connection>(port));
        dripping.back()->send_bytes("GET /healthz HTTP/1.1\r\nHo");
    }
    EXPECT_EQ(request(port, "GET", "/healthz").status, 200);
    EXPECT_EQ(dripping.front()->receive().status, 408);
}

TEST_F(HttpServerLimits, a_body_that_stops_is_408_at_its_deadline) {
    limits.body_time = 200ms;
    Connection connection(start());
    connection.send_bytes("POST /echo HTTP/1.1\r\nHost: a\r\nContent-Length: 10\r\n\r\nhalf");
    const Answer answer = connection.receive();
    EXPECT_EQ(answer.status, 408);
    EXPECT_THAT(answer.body, HasSubstr("request.timeout"));
}

TEST_F(HttpServerLimits, an_idle_connection_is_closed_without_a_word) {
    Connection connection(start());
    connection.request("GET", "/healthz");
    EXPECT_EQ(connection.receive_until_closed(), "");
}

TEST_F(HttpServerLimits, over_the_cap_of_connections_all_but_health_is_503) {
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

TEST_F(HttpServerLimits, one_address_takes_only_its_share_of_connections_and_is_told_so_at_once) {
    limits.connections_per_address = 1;
    limits.header_time = 20s;
    const int port = start();
    {
        Connection first(port);
        first.send_bytes("GET /hea");  // keeps it busy
        Connection second(port);
        const Answer refused = second.receive();  // before anything was asked
        EXPECT_EQ(refused.status, 429);
        EXPECT_THAT(refused.body, HasSubstr("quota.exceeded"));
        EXPECT_THAT(refused.body, HasSubstr("http_connections_per_address"));
        EXPECT_FALSE(refused.header("retry-after").empty());
        EXPECT_EQ(refused.header("connection"), "close");
        EXPECT_EQ(request(port, "POST", "/echo", {}, std::string(1'000'000, 'x')).status, 429);
        first.send_bytes("lthz HTTP/1.1\r\nHost: a\r\nConnection: close\r\n\r\n");
        EXPECT_EQ(first.receive().status, 200);
        EXPECT_EQ(first.receive_until_closed(), "");
    }
    Answer again;
    while ((again = request(port, "GET", "/healthz")).status == 429) {  // until the first one is counted out
    }
    EXPECT_EQ(again.status, 200);
}

TEST_F(HttpServerLimits, a_flood_from_one_address_takes_no_thread) {
    limits.connections_per_address = 1;
    limits.header_time = 20s;
    const int port = start();
    Connection first(port);
    first.send_bytes("GET /hea");
    const auto threads = [] {
        const std::filesystem::directory_iterator all("/proc/self/task");
        return std::distance(begin(all), end(all));
    };
    EXPECT_EQ(request(port, "GET", "/healthz").status, 429);
    const auto before = threads();
    std::vector<std::unique_ptr<Connection>> flood;
    for (int i = 0; i < 300; ++i) flood.push_back(std::make_unique<Connection>(port));
    for (const auto& connection : flood) EXPECT_EQ(connection->receive().status, 429);
    EXPECT_EQ(threads(), before);
}

TEST_F(HttpServerLimits, a_flood_of_refusals_is_told_once_a_second_and_none_is_forgotten) {
    limits.connections_per_address = 1;
    limits.header_time = 20s;
    const int port = start();
    Connection first(port);
    first.send_bytes("GET /hea");
    constexpr uint64_t flood = 300;
    for (uint64_t i = 0; i < flood; ++i) EXPECT_EQ(Connection(port).receive().status, 429);
    server->stop(0s);
    uint64_t told = 0;
    size_t times = 0;
    for (const Exchange& exchange : seen) {
        if (exchange.status != 429) continue;
        told += exchange.count;
        ++times;
    }
    EXPECT_EQ(told, flood);
    EXPECT_LT(times, flood);
}

TEST_F(HttpServerLimits, running_out_of_descriptors_or_memory_does_not_end_the_service) {
    const int port = start();
    for (const int error : {ENFILE, EMFILE, ENOMEM, ENOBUFS, ECONNABORTED, EPERM}) {
        const FailingCalls out_of_them(FailingCalls::Call::accept4, error, 2);
        EXPECT_EQ(request(port, "GET", "/healthz").status, 200) << error;
        EXPECT_EQ(out_of_them.left(), 0) << error;
    }
}

TEST_F(HttpServerLimits, where_the_system_gives_no_more_threads_it_says_so_and_goes_on) {
    limits.header_time = 20s;
    as_plain_user([&] {
        const int port = start();
        Connection first(port);
        EXPECT_EQ(first.request("GET", "/healthz").status, 200);
        first.send_bytes("GET /hea");  // keeps its thread
        rlimit limit{};
        ::getrlimit(RLIMIT_NPROC, &limit);
        const rlim_t before = std::exchange(limit.rlim_cur, 1);
        ::setrlimit(RLIMIT_NPROC, &limit);
        const Answer refused = Connection(port).receive();
        EXPECT_EQ(refused.status, 503);
        EXPECT_FALSE(refused.header("retry-after").empty());
        EXPECT_THAT(refused.body, HasSubstr("the system gives the service no more threads"));
        limit.rlim_cur = before;
        ::setrlimit(RLIMIT_NPROC, &limit);
        EXPECT_EQ(request(port, "GET", "/healthz").status, 200);
        server->stop(0s);
        const auto told =
            std::find_if(seen.begin(), seen.end(), [](const Exchange& e) { return e.status == 503; });
        ASSERT_NE(told, seen.end());
        EXPECT_EQ(told->fault, "there are no more threads");
    });
}

TEST_F(HttpServerLimits, the_last_answer_of_a_connection_says_that_it_is_the_last) {
    limits.requests_per_connection = 3;
    Connection connection(start());
    EXPECT_EQ(connection.request("GET", "/healthz").header("connection"), "");
    EXPECT_EQ(connection.request("GET", "/healthz").header("connection"), "");
    EXPECT_EQ(connection.request("GET", "/healthz").header("connection"), "close");
    EXPECT_EQ(connection.receive_until_closed(), "");
}

TEST_F(HttpServerLimits, a_client_that_does_not_read_its_answer_is_cut_off) {
    limits.slow_time = 20ms;
    const int port = start();
    Connection lazy(port);
    lazy.send_bytes("GET /content HTTP/1.1\r\nHost: a\r\n\r\n");
    {
        std::unique_lock lock(mutex);
        ASSERT_TRUE(was_seen.wait_for(lock, 20s, [&] { return seen.size() == 1; })) << "it holds its thread";
    }
    EXPECT_LT(lazy.receive_until_closed().size(), content_bytes);
}

}  // namespace
}  // namespace coppice::test
