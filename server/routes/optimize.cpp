// POST /v1/optimize: one asset in, a smaller one out.
#include "server/routes/routes.h"
#include "server/routes/submission.h"

namespace coppice {

Route optimize_route(Services& services) {
    return {.method = "POST",
            .pattern = "/v1/optimize",
            .handler =
                [&services](Request& request, Response& response) {
                    submit_and_wait(JobKind::optimize, request, response, services);
                },
            .takes_options = true};
}

}  // namespace coppice
