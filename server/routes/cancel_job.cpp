// POST /v1/jobs/{id}/cancel
#include "server/routes/routes.h"
#include "server/routes/submission.h"

namespace coppice {

Route cancel_job_route(Services& services) {
    return {"POST", "/v1/jobs/{id}/cancel", [&services](Request& request, Response& response) {
                response.job = request.path_parameter("id");
                answer_accepted(response, services.store.cancel(response.job));
            }};
}

}  // namespace coppice
