// One job, from its stored bytes to its stored result. Knows nothing of queues.
#pragma once

#include <functional>
#include <memory>

#include "core/base/watch.h"
#include "core/format/limits.h"
#include "server/blobs/blob_store.h"
#include "server/store/job_store.h"

namespace coppice {

struct Worked {
    JobResult result;
    std::unique_ptr<BlobWriter> hold;  // keeps the result's bytes until a job names them
};

// Throws Error, and std::bad_alloc. Deterministic for any number of threads.
Worked work(const JobRecord& record, BlobStore& blobs, const ReadLimits& limits, unsigned threads,
            const Watch& watch);

using WorkFunction = std::function<Worked(const JobRecord&, const Watch&)>;

}  // namespace coppice
