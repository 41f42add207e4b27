// A request's asset, its resources and its options, streamed into the blob store.
#pragma once

#include <memory>
#include <vector>

#include "server/http/message.h"
#include "server/routes/services.h"

namespace coppice {

struct ReceivedUpload {
    NewJob job;
    std::vector<std::unique_ptr<BlobWriter>> holds;  // keep the bytes until the job names them
};

// Reads the body: the asset itself with the options in the query, or multipart/form-data, which a comparison
// always is. Options of the
// query are checked before the first byte of the body. Throws option_*, request_*, asset_empty, storage_*.
ReceivedUpload receive_upload(JobKind kind, const Request& request, BlobStore& blobs,
                              const HttpLimits& limits);

}  // namespace coppice
