// Every operation of the service, one file each. The contract is proto/openapi.yaml; a test holds both
// together.
#pragma once

#include "server/http/router.h"
#include "server/routes/services.h"

namespace coppice {

Route optimize_route(Services& services);    // POST /v1/optimize
Route submit_route(Services& services);      // POST /v1/jobs
Route list_jobs_route(Services& services);   // GET /v1/jobs
Route get_job_route(Services& services);     // GET /v1/jobs/{id}
Route remove_job_route(Services& services);  // DELETE /v1/jobs/{id}
Route get_result_route(Services& services);  // GET /v1/jobs/{id}/result
Route get_report_route(Services& services);  // GET /v1/jobs/{id}/report
Route cancel_job_route(Services& services);  // POST /v1/jobs/{id}/cancel
Route inspect_route(Services& services);     // POST /v1/inspect
Route compare_route(Services& services);     // POST /v1/compare
Route list_algorithms_route();               // GET /v1/algorithms
Route health_route();                        // GET /healthz
Route readiness_route(Services& services);   // GET /readyz
Route metrics_route(Services& services);     // GET /metrics
Route contract_route();                      // GET /openapi.json

// services has to outlive the router.
Router make_router(Services& services);

}  // namespace coppice
