// Where jobs live, from their submission to their removal. The interface that every implementation keeps;
// tests/server/job_store_suite.h holds them to it. Thread-safe.
//
// A job is claimed by one worker at a time, under a lease and a fencing token. Who lost his lease, or whose
// job was cancelled or removed, holds a stale token: nothing that he says is taken any more.
#pragma once

#include <chrono>
#include <cstdint>
#include <functional>
#include <optional>
#include <stop_token>
#include <string>
#include <vector>

#include "proto/job.h"

namespace coppice {

// Bytes in the blob store.
struct StoredFile {
    std::string path;        // as the client named it; may be empty
    std::string media_type;  // empty when not given
    std::string sha256;
    uint64_t bytes = 0;
};

// An asset with what came along with it.
struct StoredUpload {
    StoredFile asset = {};
    std::vector<StoredFile> resources = {};
};

struct NewJob {
    JobKind kind = JobKind::optimize;
    OptimizeOptions options = {};
    CompareOptions comparison = {};
    StoredFile asset = {};  // of a comparison: the reference
    std::vector<StoredFile> resources = {};
    std::optional<StoredUpload> candidate = {};  // of a comparison
};

struct JobResult {
    StoredFile file;  // path: the file name that is offered to the client
    StoredFile
        report;  // JSON; of an inspection or a comparison the same bytes. Long where there are many instances
    uint64_t bytes_in = 0;
    uint64_t triangles_in = 0;  // stored ones; 0 but for an optimization
    uint64_t triangles_out = 0;
    std::vector<std::pair<std::string, double>> stage_ms = {};  // for Server-Timing, in order
};

// What clients see, and what the service keeps beside it.
struct JobRecord {
    Job job;
    StoredFile asset;  // of a comparison: the reference
    std::vector<StoredFile> resources;
    std::optional<StoredUpload> candidate = {};  // of a comparison
    std::optional<JobResult> result = {};        // once succeeded

    // Every file that the job was given, in the order of the members.
    std::vector<const StoredFile*> input_files() const;
};

struct Claim {
    JobRecord record;
    uint64_t token = 0;  // differs for every claim of every job
};

struct JobQuery {
    std::optional<JobStatus> status = {};
    size_t limit = 50;
    std::optional<uint64_t> before = {};  // a cursor: JobPage::next
};

struct JobPage {
    std::vector<Job> jobs;              // newest first
    std::optional<uint64_t> next = {};  // where there are more
};

struct JobCounts {
    size_t queued = 0;
    size_t running = 0;
    size_t finished = 0;
};

class JobStore {
  public:
    JobStore() = default;
    virtual ~JobStore() = default;
    JobStore(const JobStore&) = delete;
    JobStore& operator=(const JobStore&) = delete;

    // Throws queue_full.
    virtual Job submit(NewJob job) = 0;

    // The job that has waited longest, now running, with one attempt more; one whose lease ran out counts as
    // waiting. A job that has used up its attempts becomes failed with job_quarantined instead. None when
    // nothing waits.
    virtual std::optional<Claim> claim() = 0;

    // Waits until claim() may find something, or was stopped; may return early.
    virtual void wait_for_work(std::stop_token stop, std::chrono::milliseconds at_most) = 0;

    // Extends the lease and tells how far the job is; progress never goes back. False: the token is stale.
    virtual bool renew(const std::string& id, uint64_t token, const std::string& stage, double progress) = 0;

    // False: the token is stale, and nothing was changed.
    virtual bool complete(const std::string& id, uint64_t token, JobResult result) = 0;
    virtual bool fail(const std::string& id, uint64_t token, Problem problem) = 0;
    virtual bool give_back(const std::string& id,
                           uint64_t token) = 0;  // to the queue's head; the attempt is not counted

    // Throw job_not_found, job_deleted; cancel also job_finished.
    virtual Job cancel(const std::string& id) = 0;
    virtual JobRecord find(const std::string& id) = 0;
    virtual JobRecord remove(const std::string& id) = 0;  // cancels first; what it was

    // Waits until the job is finished (or removed), or the time is over, or was stopped.
    virtual void wait_until_finished(const std::string& id, std::stop_token stop,
                                     std::chrono::milliseconds at_most) = 0;

    virtual JobPage list(const JobQuery& query) = 0;
    virtual JobCounts counts() = 0;

    // Whether any job that is not removed names this blob.
    virtual bool refers_to(const std::string& sha256) = 0;

    // Finished jobs that ended before `before`, and the oldest finished ones beyond `keep`.
    virtual std::vector<std::string> expired(Time before, size_t keep) = 0;

    // Whether queued jobs are still there after a restart.
    virtual bool is_durable() const = 0;
};

struct JobStoreLimits {
    size_t queued = 1000;
    uint32_t attempts = 3;
    std::chrono::milliseconds lease{30'000};
    size_t remembered_removals = 10'000;  // ids that answer "deleted" rather than "not found"
};

using NowFunction = std::function<Time()>;
Time system_now();

std::string make_job_id();  // 32 hex digits of 128 random bits

}  // namespace coppice
