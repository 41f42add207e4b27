// GET /v1/jobs/{id}/report
#include "server/routes/finished_job.h"
#include "server/routes/result.h"
#include "server/routes/routes.h"

namespace coppice {

Route get_report_route(Services& services) {
    return {"GET", "/v1/jobs/{id}/report", [&services](Request& request, Response& response) {
                const auto record = find_succeeded(request, response, services.store);
                if (!record) return;
                response.content = stored_content(*record, record->result->report, services);
                response.content_type = "application/json";
            }};
}

}  // namespace coppice
