// What is kept, and for how long: so that the data directory does not grow for ever.
#pragma once

#include <chrono>
#include <string>

#include "server/blobs/blob_store.h"
#include "server/store/job_store.h"
#include "server/telemetry/log.h"

namespace coppice {

struct RetentionOptions {
    std::chrono::seconds age{24 * 3600};  // of finished jobs
    size_t jobs = 1000;                   // finished ones; the oldest go first
};

// Removes a job, cancelling it first, and those of its blobs that no other job names. Throws job_not_found,
// job_deleted.
void remove_job(const std::string& id, JobStore& store, BlobStore& blobs);

// Removes finished jobs that are too old or too many. Returns how many.
size_t remove_expired(const RetentionOptions& options, Time now, JobStore& store, BlobStore& blobs);

// Removes blobs that no job names: what an earlier process left behind. Returns how many.
size_t remove_unreferenced(JobStore& store, BlobStore& blobs);

}  // namespace coppice
