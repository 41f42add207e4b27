// GET /readyz: the service can take work, or 503 and why not.
#include "core/base/error.h"
#include "server/http/answer.h"
#include "server/routes/routes.h"

namespace coppice {
namespace {

void require_ready(Services& services) {
    require(!services.draining.stop_requested(), ErrorCode::service_draining, "",
            "the service is shutting down");
    const size_t queued = services.store.counts().queued;
    require(queued < services.settings.queue_length, ErrorCode::queue_full, "",
            "{} jobs wait, the limit is {}", queued, services.settings.queue_length);
    services.blobs.check_writable();
}

}  // namespace

Route readiness_route(Services& services) {
    return {"GET", "/readyz",
            [&services](Request&, Response& response) {
                try {
                    require_ready(services);
                    response.json(200, R"({"status":"ok"})");
                } catch (const Error& error) {
                    set_problem(response, to_problem(error), 503);
                }
            },
            true};
}

}  // namespace coppice
