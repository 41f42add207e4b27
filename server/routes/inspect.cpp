// POST /v1/inspect: what is in an asset.
#include "server/routes/routes.h"
#include "server/routes/submission.h"

namespace coppice {

Route inspect_route(Services& services) {
    return submit_and_wait_route("/v1/inspect", JobKind::inspect, services);
}

}  // namespace coppice
