#include "server/jobs/retention.h"

#include "core/base/error.h"

namespace coppice {
namespace {

bool remove_unless_needed(const std::string& sha256, JobStore& store, BlobStore& blobs) {
    return blobs.remove(sha256, [&] { return store.refers_to(sha256); });
}

}  // namespace

void remove_job(const std::string& id, JobStore& store, BlobStore& blobs) {
    const JobRecord was = store.remove(id);
    for (const StoredFile* file : was.input_files()) remove_unless_needed(file->sha256, store, blobs);
    if (!was.result) return;
    remove_unless_needed(was.result->file.sha256, store, blobs);
    remove_unless_needed(was.result->report.sha256, store, blobs);
}

size_t remove_expired(const RetentionOptions& options, Time now, JobStore& store, BlobStore& blobs) {
    size_t removed = 0;
    for (const std::string& id : store.expired(now - options.age, options.jobs)) {
        try {
            remove_job(id, store, blobs);
            ++removed;
        } catch (const Error& error) {
            if (error.code() != ErrorCode::job_deleted && error.code() != ErrorCode::job_not_found) throw;
        }
    }
    return removed;
}

size_t remove_unreferenced(JobStore& store, BlobStore& blobs) {
    size_t removed = 0;
    for (const std::string& sha256 : blobs.list()) {
        if (remove_unless_needed(sha256, store, blobs)) ++removed;
    }
    return removed;
}

}  // namespace coppice
