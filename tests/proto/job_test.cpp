#include "proto/job.h"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

namespace coppice {
namespace {

using std::chrono::milliseconds;

Job running_job() {
    return {.id = "0123456789abcdef0123456789abcdef",
            .status = JobStatus::running,
            .stage = "simplify",
            .progress = 0.25,
            .attempts = 1,
            .created_at = Time(milliseconds(1'700'000'000'000)),
            .started_at = Time(milliseconds(1'700'000'000'125))};
}

TEST(Job, is_printed_with_its_links_and_times) {
    Job job = running_job();
    job.options.ratio = 0.5;
    EXPECT_EQ(
        print_job(job),
        R"({"id":"0123456789abcdef0123456789abcdef","kind":"optimize","status":"running","stage":"simplify",)"
        R"("progress":0.25,"attempts":1,"created_at":"2023-11-14T22:13:20.000Z",)"
        R"("started_at":"2023-11-14T22:13:20.125Z","finished_at":null,"options":{"ratio":0.5},)"
        R"("links":{"self":"/v1/jobs/0123456789abcdef0123456789abcdef",)"
        R"("result":"/v1/jobs/0123456789abcdef0123456789abcdef/result",)"
        R"("report":"/v1/jobs/0123456789abcdef0123456789abcdef/report"}})");
}

TEST(Job, has_a_place_for_its_report_once_it_succeeded) {
    Job job = running_job();
    job.status = JobStatus::succeeded;
    const PrintedAroundReport printed = print_around_report(job);
    const auto json =
        nlohmann::json::parse(printed.before + R"({"savings":{"bytes_ratio":0.4}})" + printed.after);
    EXPECT_EQ(json["report"]["savings"]["bytes_ratio"], 0.4);
    EXPECT_EQ(json["id"], job.id);
}

TEST(Job, carries_its_problem_once_it_failed) {
    Job job = running_job();
    job.status = JobStatus::failed;
    job.problem = {.code = ErrorCode::asset_malformed, .detail = "line 3 is no vertex", .where = "line 3"};
    const auto json = nlohmann::json::parse(print_job(job));
    EXPECT_EQ(json["problem"]["code"], "asset.malformed");
    EXPECT_EQ(json["problem"]["status"], 422);
    EXPECT_FALSE(json.contains("report"));
}

TEST(Job, prints_times_in_utc_with_milliseconds) {
    EXPECT_EQ(print_time(Time(milliseconds(0))), "1970-01-01T00:00:00.000Z");
    EXPECT_EQ(print_time(Time(milliseconds(951'827'696'789))), "2000-02-29T12:34:56.789Z");
}

TEST(Job, knows_its_statuses_by_name) {
    for (const JobStatus status : {JobStatus::queued, JobStatus::running, JobStatus::succeeded,
                                   JobStatus::failed, JobStatus::cancelled}) {
        EXPECT_EQ(job_status_from_name(name(status)), status);
    }
    EXPECT_FALSE(job_status_from_name("done"));
}

TEST(Job, is_finished_when_nothing_more_will_happen) {
    EXPECT_FALSE(is_finished(JobStatus::queued));
    EXPECT_FALSE(is_finished(JobStatus::running));
    EXPECT_TRUE(is_finished(JobStatus::succeeded));
    EXPECT_TRUE(is_finished(JobStatus::failed));
    EXPECT_TRUE(is_finished(JobStatus::cancelled));
}

}  // namespace
}  // namespace coppice
