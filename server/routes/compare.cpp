// POST /v1/compare: how far one asset is from another.
#include "server/routes/routes.h"
#include "server/routes/submission.h"

namespace coppice {

Route compare_route(Services& services) {
    return submit_and_wait_route("/v1/compare", JobKind::compare, services);
}

}  // namespace coppice
