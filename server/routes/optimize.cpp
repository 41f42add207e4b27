// POST /v1/optimize: one asset in, a smaller one out.
#include "server/routes/routes.h"
#include "server/routes/submission.h"

namespace coppice {

Route optimize_route(Services& services) {
    return submit_and_wait_route("/v1/optimize", JobKind::optimize, services);
}

}  // namespace coppice
