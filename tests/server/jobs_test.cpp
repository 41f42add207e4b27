// What becomes of a job, as its client sees it.
#include "tests/server/allocated_bytes.h"
#include "tests/server/service_fixture.h"
#include "tests/server/test_scenes.h"

namespace coppice::test {
namespace {

using ::testing::HasSubstr;

class Jobs : public ServiceTest {
  protected:
    std::string finished_job() {
        const std::string job = submit(iobj_scene());
        wait_for_status(job, "succeeded");
        return job;
    }
};

TEST_F(Jobs, are_acknowledged_then_run_then_have_a_result) {
    start_gated();
    const std::string job = submit();
    gate.wait_until_entered();
    EXPECT_EQ(status_of(job), "running");
    EXPECT_THAT(get(job + "/result"), is_problem(409, "job.unfinished"));
    EXPECT_THAT(get(job + "/report"), is_problem(409, "job.unfinished"));
    gate.open();
    wait_for_status(job, "succeeded");
}

TEST_F(Jobs, results_come_whole_in_ranges_or_not_at_all_where_the_client_has_them) {
    start();
    const std::string result = finished_job() + "/result";
    const Answer whole = get(result);
    EXPECT_EQ(whole.status, 200);
    EXPECT_EQ(whole.header("accept-ranges"), "bytes");
    const std::string size = std::to_string(whole.body.size());

    const Answer part = get(result, {{"Range", "bytes=3-9"}});
    EXPECT_EQ(part.status, 206);
    EXPECT_EQ(part.body, whole.body.substr(3, 7));
    EXPECT_EQ(part.header("content-range"), "bytes 3-9/" + size);
    EXPECT_EQ(get(result, {{"Range", "Bytes=-5"}}).body, whole.body.substr(whole.body.size() - 5));

    const std::string etag = whole.header("etag");
    EXPECT_EQ(get(result, {{"If-None-Match", "\"x\", W/" + etag}}).status, 304);
    EXPECT_EQ(get(result, {{"If-None-Match", "\"x\""}}).status, 200);
    EXPECT_EQ(get(result, {{"Range", "bytes=3-9"}, {"If-Range", etag}}).status, 206);
    EXPECT_EQ(get(result, {{"Range", "bytes=3-9"}, {"If-Range", "\"x\""}}).status, 200);

    const Answer past_the_end = get(result, {{"Range", "bytes=" + size + "-"}});
    EXPECT_THAT(past_the_end, is_problem(416, "range.not_satisfiable"));
    EXPECT_EQ(past_the_end.header("content-range"), "bytes */" + size);
    EXPECT_THAT(get(result, {{"Range", "bytes=0-1,3-4"}}), is_problem(416, "range.not_satisfiable"));

    for (const HeaderList& headers : {HeaderList{}, HeaderList{{"Range", "bytes=3-9"}}}) {
        const Answer head = request(port, "HEAD", result, headers);
        EXPECT_EQ(head.status, 200);
        EXPECT_EQ(head.header("content-length"), size);
    }
}

TEST_F(Jobs, a_running_one_is_cancelled_and_its_slot_is_free_again) {
    start_gated();
    const std::string job = submit();
    gate.wait_until_entered();
    const Answer answer = post(job + "/cancel", {}, "");
    EXPECT_EQ(answer.status, 202);
    EXPECT_EQ(json_member(answer.body, "status"), "\"cancelled\"");
    EXPECT_THAT(get(job + "/result"), is_problem(409, "job.cancelled"));
    EXPECT_THAT(post(job + "/cancel", {}, ""), is_problem(409, "job.finished"));
    submit();
    gate.wait_until_entered(2);
    EXPECT_EQ(gate.stopped(), 1U);
}

TEST_F(Jobs, a_deleted_one_is_gone_with_its_bytes) {
    start();
    const std::string job = finished_job();
    EXPECT_EQ(request(port, "DELETE", job).status, 204);
    EXPECT_THAT(get(job), is_problem(410, "job.deleted"));
    EXPECT_THAT(get(job + "/result"), is_problem(410, "job.deleted"));
    EXPECT_THAT(request(port, "DELETE", job), is_problem(410, "job.deleted"));
    size_t files = 0;
    for (const auto& entry :
         std::filesystem::recursive_directory_iterator(folder.path() / "data" / "blobs")) {
        files += entry.is_regular_file() ? 1 : 0;
    }
    EXPECT_EQ(files, 0U);
}

TEST_F(Jobs, deleting_a_running_one_stops_it) {
    start_gated();
    const std::string job = submit();
    gate.wait_until_entered();
    EXPECT_EQ(request(port, "DELETE", job).status, 204);
    submit();
    gate.wait_until_entered(2);
    EXPECT_EQ(gate.stopped(), 1U);
}

TEST_F(Jobs, are_listed_newest_first_in_pages) {
    start_gated();
    const std::string first = submit();
    const std::string second = submit();
    const Answer page = get("/v1/jobs?limit=1");
    EXPECT_EQ(page.status, 200);
    EXPECT_THAT(page.body, HasSubstr(second.substr(9)));
    const std::string cursor = json_member(page.body, "next_cursor");
    const Answer next = get("/v1/jobs?limit=1&cursor=" + cursor.substr(1, cursor.size() - 2));
    EXPECT_THAT(next.body, HasSubstr(first.substr(9)));
    EXPECT_EQ(json_member(next.body, "next_cursor"), "null");
    gate.wait_until_entered();
    EXPECT_THAT(get("/v1/jobs?status=running").body, HasSubstr(first.substr(9)));
    EXPECT_THAT(get("/v1/jobs?status=failed").body, HasSubstr("\"jobs\":[]"));
}

// Of a scene with millions of instances, a report has hundreds of megabytes.
TEST_F(Jobs, have_reports_that_stay_on_disk) {
    constexpr size_t report_bytes = 4 << 20, jobs = 40;
    const std::string report = "{\"map\":\"" + std::string(report_bytes, 'x') + "\"}";
    Parts parts;
    parts.work = [report](const JobRecord&, BlobStore& blobs, const Watch&) {
        return result_of(blobs, report);
    };
    start(std::move(parts));
    const size_t before = allocated_bytes();
    std::string job;
    for (size_t i = 0; i < jobs; ++i) job = submit();
    wait_for_status(job, "succeeded");
    const Answer list = get("/v1/jobs?limit=1000&status=succeeded");
    EXPECT_EQ(list.body.find("\"report\":{"), std::string::npos);
    EXPECT_THAT(list.body, HasSubstr(job.substr(9)));
    EXPECT_LT(allocated_bytes(), before + 10 * report_bytes);  // in memory they would be 40 times that, or 80

    const Answer answer = get(job);
    EXPECT_EQ(answer.header("content-type"), "application/json");
    EXPECT_TRUE(answer.body.ends_with(",\"report\":" + report + "}"));
    EXPECT_TRUE(get(job + "/report").body == report);
}

TEST_F(Jobs, a_query_that_means_nothing_is_refused) {
    start();
    EXPECT_THAT(get("/v1/jobs?limit=1&limit=2"), is_problem(400, "option.conflict"));
    EXPECT_THAT(get("/v1/jobs?status=sleeping"), is_problem(400, "option.invalid"));
    EXPECT_THAT(get("/v1/jobs?limit=0"), is_problem(400, "option.invalid"));
    EXPECT_THAT(get("/v1/jobs?cursor=x"), is_problem(400, "option.invalid"));
    EXPECT_THAT(get("/v1/jobs?colour=red"), is_problem(400, "option.unknown"));
    EXPECT_THAT(get("/v1/jobs/0123"), is_problem(404, "job.not_found"));
    EXPECT_THAT(get("/v1/jobs/%2e%2e%2f%2e%2e%2fetc"), is_problem(404, "route.not_found"));
}

TEST_F(Jobs, a_full_queue_is_503_with_a_time_to_come_back_and_health_goes_on) {
    config.queue_length = 1;
    start_gated();
    submit();
    gate.wait_until_entered();
    submit();
    const Answer refused = post("/v1/jobs", {}, "o a\n");
    EXPECT_THAT(refused, is_problem(503, "queue.full"));
    EXPECT_FALSE(refused.header("retry-after").empty());
    EXPECT_THAT(get("/readyz"), is_problem(503, "queue.full"));
    EXPECT_EQ(get("/healthz").status, 200);
}

TEST_F(Jobs, one_that_takes_too_long_fails_with_a_time_out) {
    config.job_time = std::chrono::seconds(0);
    start_gated();
    const Answer answer = optimize("o a\n");
    EXPECT_THAT(answer, is_problem(422, "job.timeout"));
    EXPECT_THAT(answer.body, HasSubstr("job_seconds"));
}

TEST_F(Jobs, running_out_of_memory_is_told_as_such_and_anything_else_stays_in_the_log) {
    bool first = true;
    Parts parts;
    parts.work = [&first](const JobRecord&, BlobStore&, const Watch&) -> Worked {
        if (std::exchange(first, false)) throw std::bad_alloc();
        throw std::runtime_error("secret");
    };
    start(std::move(parts));
    EXPECT_THAT(optimize("o a\n"), is_problem(422, "asset.too_large"));
    const Answer internal = optimize("o a\n");
    EXPECT_THAT(internal, is_problem(500, "internal"));
    EXPECT_EQ(internal.body.find("secret"), std::string::npos);
}

TEST_F(Jobs, progress_and_stage_are_seen_while_one_runs) {
    Parts parts;
    parts.work = [this](const JobRecord& record, BlobStore& blobs, const Watch& watch) {
        watch.stage("simplify");
        watch.report(0.25);
        return gate.work()(record, blobs, watch);
    };
    start(std::move(parts));
    const std::string job = submit();
    gate.wait_until_entered();
    const auto end = std::chrono::steady_clock::now() + std::chrono::seconds(20);
    while (json_member(get(job).body, "progress") != "0.25" && std::chrono::steady_clock::now() < end) {
    }
    EXPECT_EQ(json_member(get(job).body, "stage"), "\"simplify\"");
}

}  // namespace
}  // namespace coppice::test
