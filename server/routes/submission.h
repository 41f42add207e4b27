// From a request to a job, and the wait for it.
#pragma once

#include <optional>
#include <string>

#include "server/http/message.h"
#include "server/http/router.h"
#include "server/routes/services.h"

namespace coppice {

// Receives the upload and submits it. From then on Location is set on the response, whatever becomes of it.
Job submit_upload(JobKind kind, Request& request, Response& response, Services& services);

// 202 with the job.
void answer_accepted(Response& response, const Job& job);

// What a client prefers (RFC 7240): wait=SECONDS, respond-async.
struct Preference {
    std::chrono::seconds wait;
    std::string applied;  // for Preference-Applied; empty where nothing was asked for
};

// Longer waits than the service's are cut to them. Throws request_malformed on a wait that is no number.
Preference parse_preference(const Headers& headers, const RouteSettings& settings);

// Waits as long as the client prefers, and while it is there. The job as it is then; none where it was
// removed.
std::optional<JobRecord> wait_for_job(const Job& job, const Request& request, const Preference& preference,
                                      Services& services);

// Submits, waits, and answers with the result, the problem, or 202.
void submit_and_wait(JobKind kind, Request& request, Response& response, Services& services);

// POST to that path does so.
Route submit_and_wait_route(std::string path, JobKind kind, Services& services);

}  // namespace coppice
