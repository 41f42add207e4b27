// POST /v1/inspect: what is in an asset.
#include "server/routes/routes.h"
#include "server/routes/submission.h"

namespace coppice {

Route inspect_route(Services& services) {
    return {.method = "POST",
            .pattern = "/v1/inspect",
            .handler =
                [&services](Request& request, Response& response) {
                    submit_and_wait(JobKind::inspect, request, response, services);
                },
            .takes_options = true};
}

}  // namespace coppice
