#include "server/store/memory_store.h"

#include <new>

#include "tests/server/job_store_suite.h"
#include "tests/server/out_of_memory.h"

namespace coppice::test {

INSTANTIATE_TEST_SUITE_P(Memory, JobStoreSuite,
                         ::testing::Values(JobStoreFactory{
                             "memory", [](JobStoreLimits limits, NowFunction now) {
                                 return std::make_shared<MemoryStore>(limits, std::move(now));
                             }}));

namespace {

// A store with a job that is done, one that runs and perhaps one that waits, each with blobs of its own.
class SomeJobs {
  public:
    explicit SomeJobs(bool one_waits) {
        done_ = store_.submit(job("done")).id;
        complete(*store_.claim(), "done");
        store_.submit(job("runs"));
        claim_ = *store_.claim();
        if (one_waits) waits_ = store_.submit(job("waits")).id;
    }

    void submit() { store_.submit(job("new")); }
    void claim() { store_.claim(); }
    void complete() { complete(claim_, "runs"); }
    void fail() { store_.fail(claim_.record.job.id, claim_.token, {ErrorCode::internal, long_text, {}}); }
    void give_back() { store_.give_back(claim_.record.job.id, claim_.token); }
    void cancel_what_waits() { store_.cancel(waits_); }
    void cancel_what_runs() { store_.cancel(claim_.record.job.id); }
    void remove_what_waits() { store_.remove(waits_); }
    void remove_what_is_done() { store_.remove(done_); }
    void set_aside_what_lapsed() {
        now_ += std::chrono::hours(1);
        store_.claim();
    }

    // All that can be seen of it, but for ids.
    std::string seen() {
        const JobCounts counts = store_.counts();
        std::string text = fmt::format("{} {} {}:", counts.queued, counts.running, counts.finished);
        for (const Job& listed : store_.list({}).jobs) {
            const JobRecord record = store_.find(listed.id);
            text += fmt::format(" {} {}{}{}", record.asset.path, name(record.job.status),
                                record.result ? " with a result" : "",
                                record.job.problem ? " with a problem" : "");
        }
        text += " |";
        for (const char* blob : {"new", "waits", "runs", "done"})
            for (const char* kind : {"", " resource", " result", " report"})
                if (store_.refers_to(std::string(blob) + kind)) text += fmt::format(" {}{}", blob, kind);
        return text + fmt::format(" | {}", store_.expired({}, 0).size());
    }

  private:
    // Text that no string holds without an allocation.
    inline static const std::string long_text = std::string(100, 'x');

    static NewJob job(const std::string& blob) {
        NewJob made;
        made.asset = {blob, long_text, blob, 12};
        made.resources = {{blob, long_text, blob + " resource", 12}};
        return made;
    }
    void complete(const Claim& claim, const std::string& blob) {
        JobResult result;
        result.file = {blob, long_text, blob + " result", 7};
        result.report = {blob, long_text, blob + " report", 7};
        store_.complete(claim.record.job.id, claim.token, std::move(result));
    }

    Time now_ = Time(std::chrono::hours(24 * 365 * 50));
    MemoryStore store_{{.attempts = 1}, [this] { return now_; }};
    Claim claim_;
    std::string waits_;
    std::string done_;
};

struct Call {
    const char* name;
    void (SomeJobs::*call)();
    bool one_waits = true;

    friend std::ostream& operator<<(std::ostream& out, const Call& call) { return out << call.name; }
};

class MemoryStoreWithoutMemory : public ::testing::TestWithParam<Call> {};

TEST_P(MemoryStoreWithoutMemory, is_as_it_was_before_wherever_the_call_failed) {
    const auto [name, call, one_waits] = GetParam();
    SomeJobs undisturbed(one_waits);
    (undisturbed.*call)();
    const std::string after = undisturbed.seen();
    for (size_t nth = 1; nth < 100; ++nth) {
        SomeJobs jobs(one_waits);
        const std::string before = jobs.seen();
        ASSERT_NE(before, after);
        bool failed = false;
        run_out_of_memory_at(nth);
        try {
            (jobs.*call)();
        } catch (const std::bad_alloc&) {
            failed = true;
        }
        ASSERT_EQ(has_run_out_of_memory(), failed);
        EXPECT_EQ(jobs.seen(), failed ? before : after) << "allocation " << nth;
        if (!failed) return;  // there was no n-th allocation: all were tried
        (jobs.*call)();       // now that there is memory again
        EXPECT_EQ(jobs.seen(), after) << "allocation " << nth;
    }
    FAIL() << "it allocates without an end";
}

INSTANTIATE_TEST_SUITE_P(
    Calls, MemoryStoreWithoutMemory,
    ::testing::Values(Call{"submit", &SomeJobs::submit}, Call{"claim", &SomeJobs::claim},
                      Call{"complete", &SomeJobs::complete}, Call{"fail", &SomeJobs::fail},
                      Call{"give_back", &SomeJobs::give_back},
                      Call{"cancel_what_waits", &SomeJobs::cancel_what_waits},
                      Call{"cancel_what_runs", &SomeJobs::cancel_what_runs},
                      Call{"remove_what_waits", &SomeJobs::remove_what_waits},
                      Call{"remove_what_is_done", &SomeJobs::remove_what_is_done},
                      Call{"set_aside_what_lapsed", &SomeJobs::set_aside_what_lapsed, false}),
    [](const auto& of) { return std::string(of.param.name); });

}  // namespace
}  // namespace coppice::test
