// Requests that are broken in thousands of small ways: each is answered or refused, and the service goes on.
#include <random>

#include "tests/server/service_fixture.h"
#include "tests/server/test_scenes.h"

namespace coppice::test {
namespace {

class HostileHttp : public ServiceTest {
  protected:
    HostileHttp() {
        config.http.header_time = std::chrono::milliseconds(50);
        config.http.body_time = std::chrono::milliseconds(50);
        config.http.idle_time = std::chrono::milliseconds(20);
        start();
    }
};

// A few bytes changed, dropped, doubled or cut off.
std::string mutate(std::string bytes, std::mt19937& random) {
    const auto below = [&](size_t end) { return random() % end; };
    for (size_t changes = 1 + below(3); changes > 0 && !bytes.empty(); --changes) {
        const size_t at = below(bytes.size());
        switch (below(5)) {
            case 0:
                bytes[at] = static_cast<char>(below(256));
                break;
            case 1:
                bytes.erase(at, 1 + below(4));
                break;
            case 2:
                bytes.insert(at, bytes.substr(at, 1 + below(16)));
                break;
            case 3:
                bytes.insert(at, std::string(1, "\r\n\0:;=-"[below(7)]));
                break;
            case 4:
                if (below(4) == 0) bytes.resize(at);
                break;
        }
    }
    return bytes;
}

TEST_F(HostileHttp, mutated_requests_never_stop_the_service) {
    const auto [type, form] =
        multipart({{"asset", "o a\nv 0 0 0\n", "a.obj"}, {"options", R"({"ratio":0.5})"}});
    const std::vector<std::string> seeds = {
        "GET /v1/jobs?limit=3&status=failed HTTP/1.1\r\nHost: a\r\nRange: bytes=0-1\r\nPrefer: "
        "wait=0\r\n\r\n",
        "POST /v1/jobs HTTP/1.1\r\nHost: a\r\nTransfer-Encoding: chunked\r\n\r\n4\r\no a\n\r\n0\r\n\r\n",
        "POST /v1/jobs HTTP/1.1\r\nHost: a\r\nContent-Type: " + type +
            "\r\nContent-Length: " + std::to_string(form.size()) + "\r\n\r\n" + form,
        "POST /v1/optimize?ratio=0.5 HTTP/1.1\r\nHost: a\r\nPrefer: respond-async\r\nExpect: 100-continue\r\n"
        "Content-Length: 4\r\n\r\no a\n",
    };
    std::mt19937 random(7);  // the same requests every time
    for (int i = 0; i < 200; ++i) {
        Connection connection(port);
        const std::string bytes = mutate(seeds[static_cast<size_t>(i) % seeds.size()], random);
        connection.send_bytes(bytes);
        connection.finish_sending();
        const std::string answer = connection.receive_until_closed();
        EXPECT_TRUE(answer.empty() || answer.starts_with("HTTP/1.1 ")) << bytes;
        EXPECT_EQ(answer.find("HTTP/1.1 500"), std::string::npos) << bytes << answer;
    }
    EXPECT_EQ(get("/healthz").status, 200);
}

}  // namespace
}  // namespace coppice::test
