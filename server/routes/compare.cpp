// POST /v1/compare: how far one asset is from another.
#include "server/routes/routes.h"
#include "server/routes/submission.h"

namespace coppice {

Route compare_route(Services& services) {
    return {.method = "POST",
            .pattern = "/v1/compare",
            .handler =
                [&services](Request& request, Response& response) {
                    submit_and_wait(JobKind::compare, request, response, services);
                },
            .takes_options = true};
}

}  // namespace coppice
