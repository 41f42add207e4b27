// GET /metrics
#include "server/routes/routes.h"

namespace coppice {

Route metrics_route(Services& services) {
    return {"GET", "/metrics",
            [&services](Request&, Response& response) {
                const JobCounts counts = services.store.counts();
                response.content_type = "text/plain; version=0.0.4; charset=utf-8";
                response.body = services.metrics.print(
                    {counts.queued, counts.running, counts.finished, services.settings.slots});
            },
            true};
}

}  // namespace coppice
