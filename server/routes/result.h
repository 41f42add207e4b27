// The result of a job as an answer.
#pragma once

#include "server/blobs/blob_store.h"
#include "server/http/answer.h"
#include "server/http/message.h"
#include "server/store/job_store.h"

namespace coppice {

// 200 with the bytes, and all that is said about them in headers. The record has a result.
void answer_result(Response& response, const JobRecord& record, const BlobStore& blobs);

// "attachment; filename=..." with a plain name, and the real one beside it where it is not plain (RFC 6266).
std::string content_disposition(std::string_view file_name);

}  // namespace coppice
