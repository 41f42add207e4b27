// The result of a job as an answer.
#pragma once

#include <string>
#include <string_view>

#include "server/http/message.h"
#include "server/routes/services.h"

namespace coppice {

// The bytes of a file that the job names. Throws job_deleted where it was removed meanwhile, storage_failed
// where the bytes are lost.
Content stored_content(const JobRecord& record, const StoredFile& file, const Services& services);

// 200 with the bytes, and all that is said about them in headers. The record has a result.
void answer_result(Response& response, const JobRecord& record, const Services& services);

// "attachment; filename=..." with a plain name, and the real one beside it where it is not plain (RFC 6266).
std::string content_disposition(std::string_view file_name);

}  // namespace coppice
