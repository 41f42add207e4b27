// GET /v1/jobs/{id}
#include "server/routes/routes.h"

namespace coppice {

Route get_job_route(Services& services) {
    return {"GET", "/v1/jobs/{id}", [&services](Request& request, Response& response) {
                const JobRecord record = services.store.find(request.path_parameter("id"));
                response.job = record.job.id;
                response.json(200, print_job(record.job));
                if (!is_finished(record.job.status)) response.set("Retry-After", "1");
            }};
}

}  // namespace coppice
