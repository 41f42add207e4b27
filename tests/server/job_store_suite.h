// What every job store keeps. A store's test file instantiates it:
//   INSTANTIATE_TEST_SUITE_P(Memory, JobStoreSuite, ::testing::Values(JobStoreFactory{...}));
#pragma once

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <functional>
#include <memory>
#include <ostream>
#include <set>
#include <string>
#include <thread>

#include "server/store/job_store.h"
#include "tests/server/fails_with.h"

namespace coppice::test {

// make() gives a new, empty store with these limits and this clock.
struct JobStoreFactory {
    std::string name;
    std::function<std::shared_ptr<JobStore>(JobStoreLimits, NowFunction)> make;

    friend std::ostream& operator<<(std::ostream& out, const JobStoreFactory& factory) {
        return out << factory.name;
    }
};

class JobStoreSuite : public ::testing::TestWithParam<JobStoreFactory> {
  protected:
    static NewJob job(const std::string& sha256 = "aa") {
        NewJob made;
        made.asset = {"scene.glb", "model/gltf-binary", sha256, 12};
        made.options.ratio = 0.25;
        return made;
    }
    static JobResult result(const std::string& sha256 = "rr") {
        JobResult made;
        made.file = {"scene.glb", "model/gltf-binary", sha256, 7};
        made.report = {"report.json", "application/json", sha256 + " report", 30};
        return made;
    }
    std::string submit(const std::string& sha256 = "aa") { return store->submit(job(sha256)).id; }
    JobStatus status(const std::string& id) { return store->find(id).job.status; }
    void succeed_next() {
        const auto claim = store->claim();
        store->complete(claim->record.job.id, claim->token, result());
    }

    Time now = Time(std::chrono::hours(24 * 365 * 50));
    JobStoreLimits limits = {
        .queued = 3, .attempts = 3, .lease = std::chrono::seconds(30), .remembered_removals = 2};
    std::shared_ptr<JobStore> store = GetParam().make(limits, [this] { return now; });
};

TEST_P(JobStoreSuite, a_submitted_job_is_queued_under_an_unguessable_id) {
    const Job made = store->submit(job());
    EXPECT_EQ(made.id.size(), 32U);
    EXPECT_EQ(made.status, JobStatus::queued);
    EXPECT_EQ(made.stage, "queued");
    EXPECT_EQ(made.created_at, now);
    const JobRecord found = store->find(made.id);
    EXPECT_EQ(found.asset.sha256, "aa");
    EXPECT_EQ(found.asset.path, "scene.glb");
    EXPECT_EQ(found.job.options.ratio, 0.25);
    EXPECT_NE(submit(), made.id);
}

TEST_P(JobStoreSuite, jobs_are_claimed_in_the_order_they_came_each_once) {
    const std::string first = submit();
    const std::string second = submit();
    EXPECT_EQ(store->claim()->record.job.id, first);
    EXPECT_EQ(store->claim()->record.job.id, second);
    EXPECT_FALSE(store->claim());
}

TEST_P(JobStoreSuite, a_claimed_job_runs_and_counts_the_attempt) {
    const std::string id = submit();
    const auto claim = store->claim();
    EXPECT_EQ(claim->record.job.attempts, 1U);
    const Job running = store->find(id).job;
    EXPECT_EQ(running.status, JobStatus::running);
    EXPECT_EQ(running.started_at, now);
}

TEST_P(JobStoreSuite, progress_is_seen_and_never_goes_back) {
    const std::string id = submit();
    const auto claim = store->claim();
    EXPECT_TRUE(store->renew(id, claim->token, "simplify", 0.5));
    EXPECT_TRUE(store->renew(id, claim->token, "write", 0.25));
    EXPECT_EQ(store->find(id).job.stage, "write");
    EXPECT_EQ(store->find(id).job.progress, 0.5);
}

TEST_P(JobStoreSuite, a_completed_job_has_its_result_and_report) {
    const std::string id = submit();
    const auto claim = store->claim();
    now += std::chrono::seconds(5);
    EXPECT_TRUE(store->complete(id, claim->token, result()));
    const JobRecord done = store->find(id);
    EXPECT_EQ(done.job.status, JobStatus::succeeded);
    EXPECT_EQ(done.job.progress, 1);
    EXPECT_EQ(done.job.finished_at, now);
    EXPECT_EQ(done.result->file.sha256, "rr");
    EXPECT_EQ(done.result->report.sha256, "rr report");
}

TEST_P(JobStoreSuite, a_failed_job_has_its_problem) {
    const std::string id = submit();
    const auto claim = store->claim();
    EXPECT_TRUE(store->fail(id, claim->token, {ErrorCode::asset_malformed, "cut short", "byte 4"}));
    EXPECT_EQ(status(id), JobStatus::failed);
    EXPECT_EQ(store->find(id).job.problem->where, "byte 4");
}

TEST_P(JobStoreSuite, a_job_whose_lease_ran_out_is_claimed_again_and_the_old_token_is_stale) {
    const std::string id = submit();
    const auto lost = store->claim();
    now += limits.lease + std::chrono::milliseconds(1);
    const auto rescued = store->claim();
    ASSERT_TRUE(rescued);
    EXPECT_EQ(rescued->record.job.id, id);
    EXPECT_EQ(rescued->record.job.attempts, 2U);
    EXPECT_FALSE(store->renew(id, lost->token, "write", 0.9));
    EXPECT_FALSE(store->complete(id, lost->token, result("stale")));
    EXPECT_FALSE(store->fail(id, lost->token, {}));
    EXPECT_FALSE(store->give_back(id, lost->token));
    EXPECT_TRUE(store->complete(id, rescued->token, result("good")));
    EXPECT_EQ(store->find(id).result->file.sha256, "good");
}

TEST_P(JobStoreSuite, a_renewed_lease_keeps_the_job) {
    const std::string id = submit();
    const auto claim = store->claim();
    now += limits.lease - std::chrono::seconds(1);
    EXPECT_TRUE(store->renew(id, claim->token, "read", 0));
    now += limits.lease - std::chrono::seconds(1);
    EXPECT_FALSE(store->claim());
    EXPECT_TRUE(store->renew(id, claim->token, "read", 0));
}

TEST_P(JobStoreSuite, a_job_that_loses_every_attempt_is_set_aside) {
    const std::string id = submit();
    for (uint32_t attempt = 1; attempt <= limits.attempts; ++attempt) {
        EXPECT_EQ(store->claim()->record.job.attempts, attempt);
        now += limits.lease + std::chrono::milliseconds(1);
    }
    EXPECT_FALSE(store->claim());
    EXPECT_EQ(status(id), JobStatus::failed);
    EXPECT_EQ(store->find(id).job.problem->code, ErrorCode::job_quarantined);
}

TEST_P(JobStoreSuite, a_job_that_is_given_back_is_first_again_and_keeps_its_attempts) {
    const std::string first = submit();
    submit();
    const auto claim = store->claim();
    EXPECT_TRUE(store->give_back(first, claim->token));
    EXPECT_EQ(store->find(first).job.attempts, 0U);
    EXPECT_EQ(status(first), JobStatus::queued);
    EXPECT_EQ(store->claim()->record.job.id, first);
}

TEST_P(JobStoreSuite, a_full_queue_takes_no_more_until_one_is_claimed) {
    for (size_t i = 0; i < limits.queued; ++i) submit();
    EXPECT_THAT([&] { submit(); }, fails_with(ErrorCode::queue_full, "queue_length"));
    EXPECT_FALSE(store->refers_to("never"));
    store->claim();
    EXPECT_NO_THROW(submit());
}

TEST_P(JobStoreSuite, a_waiting_job_is_cancelled_and_never_claimed) {
    const std::string id = submit();
    EXPECT_EQ(store->cancel(id).status, JobStatus::cancelled);
    EXPECT_FALSE(store->claim());
    EXPECT_EQ(store->find(id).job.problem->code, ErrorCode::job_cancelled);
}

TEST_P(JobStoreSuite, cancelling_a_running_job_makes_its_token_stale) {
    const std::string id = submit();
    const auto claim = store->claim();
    store->cancel(id);
    EXPECT_FALSE(store->renew(id, claim->token, "simplify", 0.5));
    EXPECT_FALSE(store->complete(id, claim->token, result()));
    EXPECT_EQ(status(id), JobStatus::cancelled);
}

TEST_P(JobStoreSuite, a_finished_job_cannot_be_cancelled) {
    const std::string id = submit();
    succeed_next();
    EXPECT_THAT([&] { store->cancel(id); }, fails_with(ErrorCode::job_finished, "succeeded"));
    EXPECT_EQ(status(id), JobStatus::succeeded);
}

TEST_P(JobStoreSuite, a_removed_job_is_deleted_whatever_it_was_doing) {
    const std::string queued = submit();
    store->remove(queued);
    EXPECT_FALSE(store->claim());
    const std::string running = submit();
    const auto claim = store->claim();
    EXPECT_EQ(store->remove(running).job.id, running);
    EXPECT_FALSE(store->complete(running, claim->token, result()));
    for (const std::string& id : {queued, running}) {
        EXPECT_THAT([&] { store->find(id); }, fails_with(ErrorCode::job_deleted, id));
        EXPECT_THAT([&] { store->cancel(id); }, fails_with(ErrorCode::job_deleted, id));
        EXPECT_THAT([&] { store->remove(id); }, fails_with(ErrorCode::job_deleted, id));
    }
    EXPECT_TRUE(store->list({}).jobs.empty());
}

TEST_P(JobStoreSuite, only_so_many_removals_are_remembered) {
    const std::string oldest = submit();
    store->remove(oldest);
    for (int i = 0; i < 2; ++i) store->remove(submit());
    EXPECT_THAT([&] { store->find(oldest); }, fails_with(ErrorCode::job_not_found, ""));
}

TEST_P(JobStoreSuite, an_unknown_job_is_not_found) {
    EXPECT_THAT([&] { store->find("nope"); }, fails_with(ErrorCode::job_not_found, ""));
    EXPECT_THAT([&] { store->cancel(""); }, fails_with(ErrorCode::job_not_found, ""));
    EXPECT_FALSE(store->renew("nope", 1, "read", 0));
}

TEST_P(JobStoreSuite, blobs_are_referred_to_as_long_as_a_job_names_them) {
    NewJob with_resource = job("asset");
    with_resource.resources.push_back({"a.png", "", "texture", 3});
    const std::string id = store->submit(with_resource).id;
    const std::string other = submit("asset");
    EXPECT_TRUE(store->refers_to("texture"));
    succeed_next();
    EXPECT_TRUE(store->refers_to("rr"));
    EXPECT_TRUE(store->refers_to("rr report"));
    store->remove(id);
    EXPECT_FALSE(store->refers_to("texture"));
    EXPECT_FALSE(store->refers_to("rr"));
    EXPECT_FALSE(store->refers_to("rr report"));
    EXPECT_TRUE(store->refers_to("asset"));
    store->remove(other);
    EXPECT_FALSE(store->refers_to("asset"));
}

TEST_P(JobStoreSuite, a_comparison_has_a_candidate_and_its_own_options) {
    NewJob comparison = job("reference");
    comparison.kind = JobKind::compare;
    comparison.comparison = {.samples = 20, .self_intersections = true, .candidate_entry = "b.obj"};
    comparison.candidate = {{"b.zip", "application/zip", "candidate", 4}, {{"b.png", "", "paint", 5}}};
    const std::string id = store->submit(comparison).id;
    const JobRecord record = store->claim().value().record;
    EXPECT_EQ(record.job.kind, JobKind::compare);
    EXPECT_EQ(record.job.comparison.samples, 20);
    EXPECT_TRUE(record.job.comparison.self_intersections);
    EXPECT_EQ(record.job.comparison.candidate_entry, "b.obj");
    ASSERT_TRUE(record.candidate.has_value());
    EXPECT_EQ(record.candidate->asset.sha256, "candidate");
    EXPECT_EQ(record.candidate->asset.path, "b.zip");
    ASSERT_EQ(record.candidate->resources.size(), 1U);
    EXPECT_EQ(record.candidate->resources[0].bytes, 5U);
    EXPECT_EQ(record.input_files().size(), 3U);
    EXPECT_TRUE(store->refers_to("candidate"));
    EXPECT_TRUE(store->refers_to("paint"));
    store->remove(id);
    EXPECT_FALSE(store->refers_to("candidate"));
    EXPECT_FALSE(store->refers_to("paint"));
}

TEST_P(JobStoreSuite, lists_newest_first_page_by_page_without_gaps_while_jobs_come) {
    std::vector<std::string> ids = {submit(), submit(), submit()};
    const JobPage first = store->list({.limit = 2});
    ASSERT_EQ(first.jobs.size(), 2U);
    EXPECT_EQ(first.jobs[0].id, ids[2]);
    EXPECT_EQ(first.jobs[1].id, ids[1]);
    store->claim();
    submit();
    const JobPage second = store->list({.limit = 2, .before = first.next});
    ASSERT_EQ(second.jobs.size(), 1U);
    EXPECT_EQ(second.jobs[0].id, ids[0]);
    EXPECT_FALSE(second.next);
}

TEST_P(JobStoreSuite, lists_only_the_status_that_is_asked_for) {
    const std::string done = submit();
    submit();
    succeed_next();
    const JobPage page = store->list({.status = JobStatus::succeeded});
    ASSERT_EQ(page.jobs.size(), 1U);
    EXPECT_EQ(page.jobs[0].id, done);
    EXPECT_TRUE(store->list({.status = JobStatus::failed}).jobs.empty());
}

TEST_P(JobStoreSuite, counts_what_waits_runs_and_is_done) {
    submit();
    submit();
    submit();
    succeed_next();
    store->claim();
    const JobCounts counts = store->counts();
    EXPECT_EQ(counts.queued, 1U);
    EXPECT_EQ(counts.running, 1U);
    EXPECT_EQ(counts.finished, 1U);
}

TEST_P(JobStoreSuite, finished_jobs_expire_by_age_and_by_number_the_oldest_first) {
    std::vector<std::string> ids;
    for (int i = 0; i < 3; ++i) {
        ids.push_back(submit());
        succeed_next();
        now += std::chrono::hours(1);
    }
    const std::string queued = submit();
    EXPECT_TRUE(store->expired(now - std::chrono::hours(4), 3).empty());
    EXPECT_EQ(store->expired(now - std::chrono::hours(2), 3), std::vector{ids[0]});
    EXPECT_EQ(store->expired(now - std::chrono::hours(4), 1), (std::vector{ids[0], ids[1]}));
}

TEST_P(JobStoreSuite, waiting_ends_when_the_job_does) {
    using namespace std::chrono_literals;
    const std::string id = submit();
    const auto claim = store->claim();
    std::thread worker([&] { store->complete(id, claim->token, result()); });
    store->wait_until_finished(id, {}, 20s);
    EXPECT_EQ(status(id), JobStatus::succeeded);
    worker.join();
    store->wait_until_finished(id, {}, 20s);  // at once
    store->remove(id);
    store->wait_until_finished(id, {}, 20s);  // at once too
}

TEST_P(JobStoreSuite, waiting_ends_when_it_is_stopped) {
    using namespace std::chrono_literals;
    const std::string id = submit();
    std::stop_source stop;
    std::thread stopper([&] { stop.request_stop(); });
    store->wait_until_finished(id, stop.get_token(), 20s);
    store->claim();
    store->wait_for_work(stop.get_token(), 20s);
    stopper.join();
}

TEST_P(JobStoreSuite, workers_that_claim_at_the_same_time_never_get_the_same_job) {
    auto big = GetParam().make({.queued = 200}, [this] { return now; });
    for (int i = 0; i < 200; ++i) big->submit(job());
    std::mutex mutex;
    std::multiset<std::string> claimed;
    std::vector<std::thread> workers;
    for (int i = 0; i < 4; ++i) {
        workers.emplace_back([&] {
            while (const auto claim = big->claim()) {
                big->complete(claim->record.job.id, claim->token, result());
                const std::scoped_lock lock(mutex);
                claimed.insert(claim->record.job.id);
            }
        });
    }
    for (std::thread& worker : workers) worker.join();
    EXPECT_EQ(claimed.size(), 200U);
    EXPECT_EQ(std::set(claimed.begin(), claimed.end()).size(), 200U);
}

}  // namespace coppice::test
