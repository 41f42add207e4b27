#include "server/jobs/runner.h"

#include "core/base/error.h"

namespace coppice {
namespace {

using Clock = std::chrono::steady_clock;
using namespace std::chrono_literals;

}  // namespace

Runner::Runner(JobStore& store, BlobStore& blobs, WorkFunction work, RunnerOptions options, const Log& log,
               Metrics& metrics)
    : store_(store), blobs_(blobs), work_(std::move(work)), options_(options), log_(log), metrics_(metrics) {}

Runner::~Runner() {
    drain(0ms);
}

void Runner::start() {
    slots_alive_ = options_.slots;
    try {
        for (unsigned i = 0; i < options_.slots; ++i) {
            Slot& slot = *slots_.emplace_back(std::make_unique<Slot>());
            slot.thread = std::thread([this, &slot] { run_slot(slot); });
        }
        heartbeat_ = std::thread([this] { beat(); });
    } catch (...) {  // no more threads: those that run have to end before they are destroyed
        stop_claiming_.request_stop();
        end_slots();
        throw;
    }
}

void Runner::drain(std::chrono::milliseconds grace) {
    if (!heartbeat_.joinable()) return;
    stop_claiming_.request_stop();
    {
        std::unique_lock lock(mutex_);
        slot_ended_.wait_for(lock, grace, [&] { return slots_alive_ == 0; });
    }
    end_slots();
    stop_beating_.request_stop();
    heartbeat_.join();
    slots_.clear();
}

void Runner::end_slots() {
    giving_back_ = true;
    for (const auto& slot : slots_) {
        const std::scoped_lock lock(slot->mutex);
        slot->stop.request_stop();
    }
    for (const auto& slot : slots_) {
        if (slot->thread.joinable()) slot->thread.join();
    }
}

void Runner::run_slot(Slot& slot) {
    const auto stop = stop_claiming_.get_token();
    // A store that forgets its queue with the process is worked off, as far as the grace goes.
    const auto wants_more = [&] {
        return !giving_back_ &&
               (!stop.stop_requested() || (!store_.is_durable() && store_.counts().queued > 0));
    };
    while (wants_more()) {
        try {
            if (const auto claim = store_.claim()) {
                run_job(slot, *claim);
            } else {
                store_.wait_for_work(stop, 1s);
            }
        } catch (const std::exception& exception) {  // of the store: the next try may do better
            log_.error("slot", {{"error", std::string(exception.what())}});
            std::this_thread::sleep_for(200ms);
        }
    }
    const std::scoped_lock lock(mutex_);
    --slots_alive_;
    slot_ended_.notify_all();
}

void Runner::run_job(Slot& slot, const Claim& claim) {
    {
        const std::scoped_lock lock(slot.mutex);
        slot.timed_out = false;
        slot.id = claim.record.job.id;
        slot.token = claim.token;
        slot.stage = "read";
        slot.progress = 0;
        slot.started = Clock::now();
        slot.stop = std::stop_source();
        if (giving_back_) slot.stop.request_stop();
        slot.busy = true;  // last: what is before it may throw
    }
    // Whatever throws below: a slot that stayed busy would have its lease renewed for ever.
    const auto release = [](Slot* held) {
        const std::scoped_lock lock(held->mutex);
        held->busy = false;
    };
    const std::unique_ptr<Slot, decltype(release)> held(&slot, release);
    try {
        log_.info("job started", {{"job", slot.id},
                                  {"kind", std::string(name(claim.record.job.kind))},
                                  {"attempt", static_cast<int64_t>(claim.record.job.attempts)}});
        conclude(slot, claim, work_(claim.record, blobs_, watch(slot)));
    } catch (const std::exception& exception) {
        conclude_failure(slot, claim, exception);
    }
}

void Runner::conclude(Slot& slot, const Claim& claim, Worked worked) {
    const JobResult result = worked.result;
    if (!store_.complete(slot.id, claim.token, std::move(worked.result))) {
        record_end(slot, claim, "stale", {});
        return;
    }
    if (claim.record.job.kind == JobKind::optimize) {
        metrics_.asset_optimized(result.bytes_in, result.file.bytes, result.triangles_in,
                                 result.triangles_out);
    }
    for (const auto& [stage, ms] : result.stage_ms) metrics_.stage_done(stage, ms / 1000);
    record_end(slot, claim, "succeeded",
               {{"bytes_in", static_cast<int64_t>(result.bytes_in)},
                {"bytes_out", static_cast<int64_t>(result.file.bytes)},
                {"triangles_in", static_cast<int64_t>(result.triangles_in)},
                {"triangles_out", static_cast<int64_t>(result.triangles_out)}});
}

void Runner::conclude_failure(Slot& slot, const Claim& claim, const std::exception& exception) {
    Problem problem = to_problem(exception, slot.id);
    if (problem.code == ErrorCode::job_cancelled) {
        bool timed_out = false;
        {
            const std::scoped_lock lock(slot.mutex);
            timed_out = slot.timed_out;
        }
        if (!timed_out) {  // cancelled, removed, or the service ends: only in the last case is the token good
                           // still
            const bool given_back = store_.give_back(slot.id, claim.token);
            record_end(slot, claim, given_back ? "given back" : "cancelled", {});
            return;
        }
        problem = {
            ErrorCode::job_timeout,
            fmt::format("the job took longer than {} s (job_seconds)", options_.job_time.count() / 1000),
            {}};
    }
    const bool taken = store_.fail(slot.id, claim.token, problem);
    record_end(slot, claim, taken ? "failed" : "stale",
               {{"code", std::string(name(problem.code))}, {"error", std::string(exception.what())}},
               taken && is_our_fault(problem.code));
}

void Runner::record_end(const Slot& slot, const Claim& claim, const std::string& status,
                        const Log::Fields& more, bool failed_here) {
    const double seconds = std::chrono::duration<double>(Clock::now() - slot.started).count();
    const std::string kind(name(claim.record.job.kind));
    Log::Fields fields = {{"job", slot.id}, {"kind", kind}, {"status", status}, {"ms", seconds * 1000}};
    fields.insert(fields.end(), more.begin(), more.end());
    failed_here ? log_.error("job ended", fields) : log_.info("job ended", fields);
    metrics_.job_done(kind, status, seconds);  // last: whoever sees it counted sees all of it
}

// The algorithm's threads only leave a note; the heartbeat brings it to the store.
Watch Runner::watch(Slot& slot) {
    Watch made;
    {
        const std::scoped_lock lock(slot.mutex);
        made.stop = slot.stop.get_token();
    }
    made.progress = [&slot](double fraction) {
        const std::scoped_lock lock(slot.mutex);
        slot.progress = fraction;
    };
    made.stage = [&slot](std::string_view stage) {
        const std::scoped_lock lock(slot.mutex);
        slot.stage = stage;
    };
    return made;
}

void Runner::beat() {
    std::mutex mutex;
    std::condition_variable_any never;
    const auto stop = stop_beating_.get_token();
    while (!stop.stop_requested()) {
        for (const auto& slot : slots_) beat_slot(*slot);
        std::unique_lock lock(mutex);
        never.wait_for(lock, stop, options_.heartbeat, [] { return false; });
    }
}

void Runner::beat_slot(Slot& slot) {
    const std::scoped_lock lock(slot.mutex);
    if (!slot.busy) return;
    if (Clock::now() - slot.started > options_.job_time) {
        slot.timed_out = true;
        slot.stop.request_stop();
    }
    try {
        if (!store_.renew(slot.id, slot.token, slot.stage, slot.progress)) slot.stop.request_stop();
    } catch (const std::exception& exception) {  // the lease lasts for a while without us
        log_.error("heartbeat", {{"job", slot.id}, {"error", std::string(exception.what())}});
    }
}

}  // namespace coppice
