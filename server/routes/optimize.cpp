// POST /v1/optimize: one asset in, a smaller one out.
#include "server/routes/routes.h"
#include "server/routes/submission.h"

namespace coppice {

Route optimize_route(Services& services) {
    return {"POST", "/v1/optimize", [&services](Request& request, Response& response) {
                submit_and_wait(JobKind::optimize, request, response, services);
            }};
}

}  // namespace coppice
