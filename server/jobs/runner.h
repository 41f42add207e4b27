// The pool of slots: each claims a job, works on it, and says how it ended.
#pragma once

#include <atomic>
#include <chrono>
#include <condition_variable>
#include <cstdint>
#include <functional>
#include <memory>
#include <mutex>
#include <thread>
#include <vector>

#include "server/jobs/work.h"
#include "server/telemetry/log.h"
#include "server/telemetry/metrics.h"

namespace coppice {

struct RunnerOptions {
    unsigned slots = 1;
    std::chrono::milliseconds job_time{300'000};
    std::chrono::milliseconds heartbeat{100};  // how often leases are renewed, and cancellations noticed
};

class Runner {
  public:
    // All have to outlive it. work is called from as many threads as there are slots.
    Runner(JobStore& store, BlobStore& blobs, WorkFunction work, RunnerOptions options, const Log& log,
           Metrics& metrics);
    ~Runner();  // drain(0)
    Runner(const Runner&) = delete;
    Runner& operator=(const Runner&) = delete;

    void start();

    // Claims no more (unless the store forgets what waits: then that is worked off too), lets what runs end
    // within the grace, and gives back what does not.
    void drain(std::chrono::milliseconds grace);

  private:
    // What a slot is doing; for the heartbeat.
    struct Slot {
        std::thread thread;
        std::mutex mutex;
        bool busy = false;
        bool timed_out = false;
        std::string id;
        uint64_t token = 0;
        std::string stage;
        double progress = 0;
        std::chrono::steady_clock::time_point started;
        std::stop_source stop;
    };

    void end_slots();
    void run_slot(Slot& slot);
    void run_job(Slot& slot, const Claim& claim);
    void conclude(Slot& slot, const Claim& claim, Worked worked);
    void conclude_failure(Slot& slot, const Claim& claim, const std::exception& exception);
    void record_end(const Slot& slot, const Claim& claim, const std::string& status, const Log::Fields& more,
                    bool failed_here = false);
    Watch watch(Slot& slot);
    void beat();
    void beat_slot(Slot& slot);

    JobStore& store_;
    BlobStore& blobs_;
    WorkFunction work_;
    RunnerOptions options_;
    const Log& log_;
    Metrics& metrics_;
    std::vector<std::unique_ptr<Slot>> slots_;
    std::thread heartbeat_;
    std::stop_source stop_claiming_;
    std::stop_source stop_beating_;
    std::atomic<bool> giving_back_ = false;
    std::mutex mutex_;
    std::condition_variable_any slot_ended_;
    size_t slots_alive_ = 0;
};

}  // namespace coppice
