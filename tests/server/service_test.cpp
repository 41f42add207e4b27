// The service as a whole: how it starts, tells of itself, and ends.
#include "tests/server/service_fixture.h"
#include "tests/server/test_scenes.h"

#include <spdlog/logger.h>
#include <spdlog/sinks/ostream_sink.h>

#include <future>
#include <sstream>

#include "core/base/error.h"
#include "tests/server/fails_with.h"

namespace coppice::test {
namespace {

using namespace std::chrono_literals;
using ::testing::HasSubstr;

class ServiceAsAWhole : public ServiceTest {
  protected:
    // The figures as soon as they have the line; the last ones where they never do.
    Answer metrics_with(std::string_view line) const {
        const auto end = std::chrono::steady_clock::now() + 20s;
        Answer metrics = get("/metrics");
        while (metrics.body.find(line) == std::string::npos && std::chrono::steady_clock::now() < end)
            metrics = get("/metrics");
        return metrics;
    }
};

TEST_F(ServiceAsAWhole, says_that_it_lives_and_is_ready) {
    start();
    EXPECT_EQ(get("/healthz").body, R"({"status":"ok"})");
    EXPECT_EQ(get("/readyz").status, 200);
}

TEST_F(ServiceAsAWhole, tells_its_contract_and_its_algorithms) {
    start();
    EXPECT_THAT(get("/openapi.json").body, HasSubstr("/v1/optimize"));
    EXPECT_THAT(get("/v1/algorithms").body, HasSubstr("\"its\""));
}

TEST_F(ServiceAsAWhole, counts_what_it_does) {
    start();
    ASSERT_EQ(optimize(iobj_scene()).status, 200);
    get("/nothing");
    // Requests and jobs are counted after their client was told: ask until each line is there.
    for (const char* line :
         {R"(coppice_http_requests_total{method="POST",route="/v1/optimize",status="200"} 1)",
          R"(coppice_http_requests_total{method="GET",route="none",status="404"} 1)",
          R"(coppice_jobs_total{kind="optimize",status="succeeded"} 1)",
          R"(coppice_triangles_total{side="in"} 128)",
          R"(coppice_stage_duration_seconds_count{stage="simplify"} 1)",
          R"(coppice_jobs{status="finished"} 1)", "coppice_http_request_duration_seconds_bucket"}) {
        const Answer metrics = metrics_with(line);
        EXPECT_THAT(metrics.header("content-type"), HasSubstr("text/plain"));
        EXPECT_THAT(metrics.body, HasSubstr(line));
    }
}

TEST_F(ServiceAsAWhole, logs_one_line_a_request_that_no_client_can_break) {
    std::ostringstream lines;
    Parts parts;
    parts.log = std::make_shared<Log>(
        std::make_shared<spdlog::logger>("test", std::make_shared<spdlog::sinks::ostream_sink_mt>(lines)));
    start(std::move(parts));
    request(port, "GET", "/a%0d%0a%22%ff", {{"X-Request-Id", "mine"}});
    service->drain();
    std::string found;
    std::istringstream read(lines.str());
    for (std::string line; std::getline(read, line);) {
        EXPECT_TRUE(line.starts_with("{\"time\":\"") && line.ends_with("}")) << line;
        if (line.find("\"id\":\"mine\"") != std::string::npos) found = line;
    }
    EXPECT_THAT(found, HasSubstr(R"("method":"GET","path":"/a\u000d\u000a\")"));
    EXPECT_THAT(found, HasSubstr(R"("status":404)"));
}

TEST_F(ServiceAsAWhole, draining_lets_a_running_job_end_and_answers_who_waits_for_it) {
    config.drain_time = 20s;
    start_gated();
    auto waiting = std::async(std::launch::async, [&] { return optimize("o a\n"); });
    gate.wait_until_entered();
    auto drained = std::async(std::launch::async, [&] { service->drain(); });
    Answer ready;
    while ((ready = get("/readyz")).status == 200) {
    }
    EXPECT_THAT(ready, is_problem(503, "service.draining"));
    EXPECT_THAT(optimize("o b\n"), is_problem(503, "service.draining"));
    gate.open();
    EXPECT_NE(waiting.get().status, 0);
    drained.get();
    EXPECT_THROW(Connection{port}, std::runtime_error);
}

TEST_F(ServiceAsAWhole, a_job_that_does_not_end_is_given_back_and_who_waits_is_told) {
    start_gated();
    auto waiting = std::async(std::launch::async, [&] { return optimize("o a\n"); });
    gate.wait_until_entered();
    service->drain();
    const Answer answer = waiting.get();
    EXPECT_THAT(answer, is_problem(503, "service.draining"));
    EXPECT_THAT(answer.header("location"), ::testing::StartsWith("/v1/jobs/"));
}

TEST_F(ServiceAsAWhole, old_jobs_and_what_an_earlier_process_left_are_tidied_away) {
    start();
    const std::string job = submit(iobj_scene());
    wait_for_status(job, "succeeded");
    service.reset();
    start();
    const auto blobs = folder.path() / "data" / "blobs";
    const auto files = [&] {
        size_t count = 0;
        for (const auto& entry : std::filesystem::recursive_directory_iterator(blobs))
            count += entry.is_regular_file();
        return count;
    };
    const auto end = std::chrono::steady_clock::now() + 20s;
    while (files() > 0 && std::chrono::steady_clock::now() < end) {
    }
    EXPECT_EQ(files(), 0U);
}

TEST_F(ServiceAsAWhole, a_data_directory_belongs_to_one_service) {
    start();
    EXPECT_THAT([&] { Service second(config); }, fails_with(ErrorCode::storage_failed, "another process"));
}

}  // namespace
}  // namespace coppice::test
