#include "server/routes/finished_job.h"

#include "core/base/error.h"
#include "server/http/answer.h"

namespace coppice {

std::optional<JobRecord> find_succeeded(const Request& request, Response& response, JobStore& store) {
    JobRecord record = store.find(request.path_parameter("id"));
    response.job = record.job.id;
    if (!is_finished(record.job.status)) {
        response.set("Retry-After", "1");
        fail(ErrorCode::job_unfinished, "",
             fmt::format("the job {} is {}; ask again when it has ended", record.job.id,
                         name(record.job.status)));
    }
    if (record.result) return record;
    set_problem(response, record.job.problem.value_or(Problem{}), 409);
    response.fault.clear();  // it was logged when the job failed
    return std::nullopt;
}

}  // namespace coppice
