// POST /v1/inspect: what is in an asset.
#include "server/routes/routes.h"
#include "server/routes/submission.h"

namespace coppice {

Route inspect_route(Services& services) {
    return {"POST", "/v1/inspect", [&services](Request& request, Response& response) {
                submit_and_wait(JobKind::inspect, request, response, services);
            }};
}

}  // namespace coppice
