// What asks for a result, and has to be told where there is none.
#pragma once

#include <optional>

#include "server/http/message.h"
#include "server/store/job_store.h"

namespace coppice {

// The job that the path names. None where it failed or was cancelled: then the response is a 409 with its
// problem. Throws job_unfinished, job_not_found, job_deleted.
std::optional<JobRecord> find_succeeded(const Request& request, Response& response, JobStore& store);

}  // namespace coppice
