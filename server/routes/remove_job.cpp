// DELETE /v1/jobs/{id}: the job and its bytes, cancelling it first.
#include "server/jobs/retention.h"
#include "server/routes/routes.h"

namespace coppice {

Route remove_job_route(Services& services) {
    return {"DELETE", "/v1/jobs/{id}", [&services](Request& request, Response& response) {
                response.job = request.path_parameter("id");
                remove_job(response.job, services.store, services.blobs);
                response.status = 204;
            }};
}

}  // namespace coppice
