// POST /v1/jobs: takes an asset and does not wait.
#include "server/routes/routes.h"
#include "server/routes/submission.h"

namespace coppice {

Route submit_route(Services& services) {
    return {.method = "POST",
            .pattern = "/v1/jobs",
            .handler =
                [&services](Request& request, Response& response) {
                    answer_accepted(response, submit_upload(JobKind::optimize, request, response, services));
                },
            .takes_options = true};
}

}  // namespace coppice
