#include "server/store/memory_store.h"

#include <algorithm>

#include "core/base/error.h"

namespace coppice {

MemoryStore::MemoryStore(JobStoreLimits limits, NowFunction now) : limits_(limits), now_(std::move(now)) {}

Job MemoryStore::submit(NewJob job) {
    const std::scoped_lock lock(mutex_);
    require(queue_.size() < limits_.queued, ErrorCode::queue_full, "",
            "{} jobs wait already, the limit is {} (queue_length); try again soon", queue_.size(),
            limits_.queued);
    const uint64_t sequence = next_sequence_++;
    Entry made;
    made.sequence = sequence;
    made.record.job.id = make_job_id();
    made.record.job.kind = job.kind;
    made.record.job.options = std::move(job.options);
    made.record.job.created_at = now_();
    made.record.asset = std::move(job.asset);
    made.record.resources = std::move(job.resources);
    Job view = made.record.job;
    try {
        const Entry& entry = jobs_.emplace(view.id, std::move(made)).first->second;
        by_sequence_.emplace(sequence, view.id);
        queue_.emplace(sequence, view.id);
        add_references(blobs_of(entry.record));
    } catch (...) {  // no memory
        queue_.erase(sequence);
        by_sequence_.erase(sequence);
        jobs_.erase(view.id);
        throw;
    }
    work_.notify_one();
    return view;
}

std::optional<Claim> MemoryStore::claim() {
    const std::scoped_lock lock(mutex_);
    requeue_lapsed();
    if (queue_.empty()) return std::nullopt;
    Entry& next = jobs_.at(queue_.begin()->second);
    Claim claim{next.record, next_token_++};  // first: it may find no memory
    running_.insert(queue_.extract(queue_.begin()));
    const Time now = now_();
    next.token = claim.token;
    next.lease_until = now + limits_.lease;
    for (Job* const job : {&next.record.job, &claim.record.job}) {
        job->status = JobStatus::running;
        job->stage = "read";
        job->progress = 0;
        ++job->attempts;
        if (!job->started_at) job->started_at = now;
    }
    return claim;
}

// A worker that has not renewed its lease is taken for dead.
void MemoryStore::requeue_lapsed() {
    std::vector<std::string> lapsed;
    for (const auto& [sequence, id] : running_) {
        if (jobs_.at(id).lease_until < now_()) lapsed.push_back(id);
    }
    for (const std::string& id : lapsed) {
        Entry& dead = jobs_.at(id);
        if (dead.record.job.attempts >= limits_.attempts) {
            Problem problem{ErrorCode::job_quarantined,
                            fmt::format("{} attempts ended without an answer; the job is set aside",
                                        dead.record.job.attempts),
                            {}};
            finish(dead, JobStatus::failed);
            dead.record.job.problem = std::move(problem);
            continue;
        }
        queue_.insert(running_.extract(dead.sequence));
        dead.token = 0;
        dead.record.job.status = JobStatus::queued;
        dead.record.job.stage = "queued";
        dead.record.job.progress = 0;
    }
}

void MemoryStore::wait_for_work(std::stop_token stop, std::chrono::milliseconds at_most) {
    std::unique_lock lock(mutex_);
    work_.wait_for(lock, stop, at_most, [&] { return !queue_.empty(); });
}

MemoryStore::Entry* MemoryStore::current(const std::string& id, uint64_t token) {
    const auto found = jobs_.find(id);
    return found != jobs_.end() && token != 0 && found->second.token == token ? &found->second : nullptr;
}

bool MemoryStore::renew(const std::string& id, uint64_t token, const std::string& stage, double progress) {
    const std::scoped_lock lock(mutex_);
    Entry* const found = current(id, token);
    if (found == nullptr) return false;
    found->lease_until = now_() + limits_.lease;
    found->record.job.stage = stage;
    found->record.job.progress = std::max(found->record.job.progress, std::clamp(progress, 0.0, 1.0));
    return true;
}

void MemoryStore::finish(Entry& done, JobStatus status) {
    const Time now = now_();
    done_.emplace(std::pair(now, done.sequence), done.record.job.id);  // first: it may find no memory
    end(done, status, now);
}

void MemoryStore::end(Entry& done, JobStatus status, Time now) {
    queue_.erase(done.sequence);
    running_.erase(done.sequence);
    done.token = 0;
    done.record.job.status = status;
    done.record.job.finished_at = now;
    finished_.notify_all();
}

bool MemoryStore::complete(const std::string& id, uint64_t token, JobResult result) {
    const std::scoped_lock lock(mutex_);
    Entry* const found = current(id, token);
    if (found == nullptr) return false;
    const Blobs blobs = {&result.file.sha256, &result.report.sha256};
    add_references(blobs);
    try {
        finish(*found, JobStatus::succeeded);
    } catch (...) {  // no memory
        drop_references(blobs);
        throw;
    }
    found->record.job.progress = 1;
    found->record.job.stage = "write";
    found->record.result = std::move(result);
    return true;
}

bool MemoryStore::fail(const std::string& id, uint64_t token, Problem problem) {
    const std::scoped_lock lock(mutex_);
    Entry* const found = current(id, token);
    if (found == nullptr) return false;
    finish(*found, JobStatus::failed);
    found->record.job.problem = std::move(problem);
    return true;
}

bool MemoryStore::give_back(const std::string& id, uint64_t token) {
    const std::scoped_lock lock(mutex_);
    Entry* const found = current(id, token);
    if (found == nullptr) return false;
    found->token = 0;
    Job& job = found->record.job;
    job.status = JobStatus::queued;
    job.stage = "queued";
    job.progress = 0;
    --job.attempts;
    queue_.insert(running_.extract(found->sequence));
    work_.notify_one();
    return true;
}

MemoryStore::Entry& MemoryStore::entry(const std::string& id) {
    const auto found = jobs_.find(id);
    require(!removed_ids_.contains(id), ErrorCode::job_deleted, "", "the job {} was deleted", id);
    // What was asked for is not repeated: it may be anything.
    require(found != jobs_.end(), ErrorCode::job_not_found, "", "there is no job with this id");
    return found->second;
}

Job MemoryStore::cancel(const std::string& id) {
    const std::scoped_lock lock(mutex_);
    Entry& found = entry(id);
    Job& job = found.record.job;
    require(!is_finished(job.status), ErrorCode::job_finished, "",
            "the job is {} and cannot be cancelled any more", name(job.status));
    Problem problem{ErrorCode::job_cancelled, "the job was cancelled", {}};
    Job view = job;
    view.problem = problem;
    finish(found, JobStatus::cancelled);
    view.status = job.status;
    view.finished_at = job.finished_at;
    job.problem = std::move(problem);
    return view;
}

JobRecord MemoryStore::find(const std::string& id) {
    const std::scoped_lock lock(mutex_);
    return entry(id).record;
}

JobRecord MemoryStore::remove(const std::string& id) {
    const std::scoped_lock lock(mutex_);
    Entry& found = entry(id);
    const Blobs blobs = blobs_of(found.record);
    removed_.push_back(id);   // by itself it means nothing
    removed_ids_.insert(id);  // the last that may find no memory
    if (is_finished(found.record.job.status)) {
        done_.erase({*found.record.job.finished_at, found.sequence});
    } else {
        end(found, JobStatus::cancelled, now_());
    }
    by_sequence_.erase(found.sequence);
    drop_references(blobs);
    JobRecord was = std::move(found.record);
    jobs_.erase(id);
    if (removed_.size() > limits_.remembered_removals) {
        removed_ids_.erase(removed_.front());
        removed_.pop_front();
    }
    return was;
}

MemoryStore::Blobs MemoryStore::blobs_of(const JobRecord& record) {
    Blobs blobs = {&record.asset.sha256};
    for (const StoredFile& resource : record.resources) blobs.push_back(&resource.sha256);
    if (record.result) {
        blobs.push_back(&record.result->file.sha256);
        blobs.push_back(&record.result->report.sha256);
    }
    return blobs;
}

void MemoryStore::add_references(const Blobs& blobs) {
    size_t added = 0;
    try {
        for (; added < blobs.size(); ++added) ++references_[*blobs[added]];
    } catch (...) {  // no memory
        drop_references(std::span(blobs).first(added));
        throw;
    }
}

void MemoryStore::drop_references(std::span<const std::string* const> blobs) {
    for (const std::string* const sha256 : blobs) {
        const auto found = references_.find(*sha256);
        if (--found->second == 0) references_.erase(found);
    }
}

void MemoryStore::wait_until_finished(const std::string& id, std::stop_token stop,
                                      std::chrono::milliseconds at_most) {
    std::unique_lock lock(mutex_);
    finished_.wait_for(lock, stop, at_most, [&] {
        const auto found = jobs_.find(id);
        return found == jobs_.end() || is_finished(found->second.record.job.status);
    });
}

JobPage MemoryStore::list(const JobQuery& query) {
    const std::scoped_lock lock(mutex_);
    JobPage page;
    auto next = query.before ? by_sequence_.lower_bound(*query.before) : by_sequence_.end();
    uint64_t last = 0;
    while (next != by_sequence_.begin()) {
        --next;
        const Job& job = jobs_.at(next->second).record.job;
        if (query.status && job.status != *query.status) continue;
        if (page.jobs.size() == query.limit) {
            page.next = last;
            break;
        }
        page.jobs.push_back(job);
        last = next->first;
    }
    return page;
}

JobCounts MemoryStore::counts() {
    const std::scoped_lock lock(mutex_);
    return {queue_.size(), running_.size(), done_.size()};
}

bool MemoryStore::refers_to(const std::string& sha256) {
    const std::scoped_lock lock(mutex_);
    return references_.contains(sha256);
}

std::vector<std::string> MemoryStore::expired(Time before, size_t keep) {
    const std::scoped_lock lock(mutex_);
    std::vector<std::string> ids;
    size_t left = done_.size();
    for (const auto& [ended, id] : done_) {
        if (ended.first >= before && left <= keep) break;
        ids.push_back(id);
        --left;
    }
    return ids;
}

}  // namespace coppice
