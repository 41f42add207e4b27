// POST /v1/compare: how far one asset is from another.
#include "server/routes/routes.h"
#include "server/routes/submission.h"

namespace coppice {

Route compare_route(Services& services) {
    return {"POST", "/v1/compare", [&services](Request& request, Response& response) {
                submit_and_wait(JobKind::compare, request, response, services);
            }};
}

}  // namespace coppice
