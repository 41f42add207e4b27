// Jobs in memory: gone with the process. Where memory runs out within a call, what it began is taken back.
#pragma once

#include <condition_variable>
#include <deque>
#include <map>
#include <mutex>
#include <span>
#include <unordered_map>
#include <unordered_set>
#include <vector>

#include "server/store/job_store.h"

namespace coppice {

class MemoryStore final : public JobStore {
  public:
    explicit MemoryStore(JobStoreLimits limits = {}, NowFunction now = system_now);

    Job submit(NewJob job) override;
    std::optional<Claim> claim() override;
    void wait_for_work(std::stop_token stop, std::chrono::milliseconds at_most) override;
    bool renew(const std::string& id, uint64_t token, const std::string& stage, double progress) override;
    bool complete(const std::string& id, uint64_t token, JobResult result) override;
    bool fail(const std::string& id, uint64_t token, Problem problem) override;
    bool give_back(const std::string& id, uint64_t token) override;
    Job cancel(const std::string& id) override;
    JobRecord find(const std::string& id) override;
    JobRecord remove(const std::string& id) override;
    void wait_until_finished(const std::string& id, std::stop_token stop,
                             std::chrono::milliseconds at_most) override;
    JobPage list(const JobQuery& query) override;
    JobCounts counts() override;
    bool refers_to(const std::string& sha256) override;
    std::vector<std::string> expired(Time before, size_t keep) override;
    bool is_durable() const override { return false; }

  private:
    struct Entry {
        JobRecord record;
        uint64_t sequence = 0;  // order of submission
        uint64_t token = 0;     // of the current claim; 0: none
        Time lease_until = {};
    };

    Entry& entry(const std::string& id);                    // throws job_not_found, job_deleted
    Entry* current(const std::string& id, uint64_t token);  // null: stale
    void finish(Entry& done, JobStatus status);
    void end(Entry& done, JobStatus status, Time now);  // finds no place for it among those that are done

    using Blobs = std::vector<const std::string*>;  // into a record or a result
    static Blobs blobs_of(const JobRecord& record);
    void add_references(const Blobs& blobs);
    void drop_references(std::span<const std::string* const> blobs);
    void requeue_lapsed();

    const JobStoreLimits limits_;
    const NowFunction now_;
    std::mutex mutex_;
    std::condition_variable_any work_;
    std::condition_variable_any finished_;
    std::unordered_map<std::string, Entry> jobs_;
    std::map<uint64_t, std::string> by_sequence_;
    std::map<uint64_t, std::string> queue_;  // by sequence: what was given back is first again
    std::map<uint64_t, std::string> running_;
    std::map<std::pair<Time, uint64_t>, std::string> done_;  // oldest end first
    std::unordered_map<std::string, int> references_;        // blob -> jobs that name it
    std::deque<std::string> removed_;
    std::unordered_set<std::string> removed_ids_;
    uint64_t next_sequence_ = 1;
    uint64_t next_token_ = 1;
};

}  // namespace coppice
