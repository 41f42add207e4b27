// GET /v1/jobs/{id}: how the job is, with its report once it succeeded, which is sent from where it lies.
#include "server/routes/result.h"
#include "server/routes/routes.h"

namespace coppice {
namespace {

Content with_report(const JobRecord& record, const Services& services) {
    PrintedAroundReport printed = print_around_report(record.job);
    return join({content_of(std::move(printed.before)),
                 stored_content(record, record.result->report, services),
                 content_of(std::move(printed.after))});
}

}  // namespace

Route get_job_route(Services& services) {
    return {"GET", "/v1/jobs/{id}", [&services](Request& request, Response& response) {
                const JobRecord record = services.store.find(request.path_parameter("id"));
                response.job = record.job.id;
                if (record.result) {
                    response.json(200, {});
                    response.content = with_report(record, services);
                } else {
                    response.json(200, print_job(record.job));
                }
                if (!is_finished(record.job.status)) response.set("Retry-After", "1");
            }};
}

}  // namespace coppice
