// One job, from its stored bytes to its stored result. Knows nothing of queues.
#pragma once

#include <functional>
#include <memory>
#include <vector>

#include "core/base/watch.h"
#include "core/format/limits.h"
#include "server/blobs/blob_store.h"
#include "server/store/job_store.h"

namespace coppice {

struct Worked {
    JobResult result;
    std::vector<std::unique_ptr<BlobWriter>> holds;  // keep the result's bytes until a job names them
};

// Stores bytes that the job will name.
StoredFile store_bytes(Worked& worked, BlobStore& blobs, ByteView bytes, std::string file_name,
                       std::string media_type);

// Throws Error, and std::bad_alloc. Deterministic for any number of threads.
Worked work(const JobRecord& record, BlobStore& blobs, const ReadLimits& limits, unsigned threads,
            const Watch& watch);

using WorkFunction = std::function<Worked(const JobRecord&, BlobStore&, const Watch&)>;

}  // namespace coppice
