// The HTTP layer by itself, with routes that do what a test needs.
#pragma once

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <condition_variable>
#include <future>
#include <memory>
#include <mutex>
#include <stdexcept>
#include <string>
#include <vector>

#include "core/base/error.h"
#include "server/http/server.h"
#include "tests/server/http_client.h"

namespace coppice::test {

using namespace std::chrono_literals;

inline std::string read_all(Body& body) {
    Bytes all;
    Bytes some(1000);
    while (const size_t got = body.read(some)) append(all, ByteView(some).first(got));
    return std::string(as_text(all));
}

class HttpServerTest : public ::testing::Test {
  protected:
    HttpServerTest() {
        limits.body_bytes = 1 << 20;
        limits.header_time = 1s;
        limits.idle_time = 2s;
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
        router.add({"GET", "/failing", [](Request&, Response& response) {
                        response.content_type = "model/gltf-binary";
                        response.content = Content{1'000'000, [](uint64_t offset, std::span<std::byte> into) {
                                                       if (offset > 500'000)
                                                           throw std::runtime_error("the disk is broken");
                                                       return into.size();
                                                   }};
                    }});
        router.add({"GET", "/content", [](Request&, Response& response) {
                        response.content_type = "model/gltf-binary";
                        response.content = Content{
                            content_bytes, [](uint64_t offset, std::span<std::byte> into) {
                                std::fill(into.begin(), into.end(), static_cast<std::byte>('a' + offset % 2));
                                return into.size();
                            }};
                    }});
        router.add({"GET", "/things/{id}/part",
                    [](Request& in, Response& response) { response.json(200, in.path_parameter("id")); }});
        server = std::make_unique<HttpServer>(std::move(router), limits, [this](const Exchange& exchange) {
            const std::scoped_lock lock(mutex);
            seen.push_back(exchange);
            was_seen.notify_all();
        });
        return server->start("127.0.0.1", 0);
    }

    HttpLimits limits;
    std::promise<void> entered;
    std::promise<void> gate;
    static constexpr size_t content_bytes = 30'000'000;  // more than the system keeps for a slow reader
    std::mutex mutex;
    std::condition_variable was_seen;
    std::vector<Exchange> seen;
    std::unique_ptr<HttpServer> server;
};

}  // namespace coppice::test
