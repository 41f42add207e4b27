#include "server/routes/routes.h"

namespace coppice {

Router make_router(Services& services) {
    Router router;
    router.add(optimize_route(services));
    router.add(submit_route(services));
    router.add(list_jobs_route(services));
    router.add(get_job_route(services));
    router.add(remove_job_route(services));
    router.add(get_result_route(services));
    router.add(get_report_route(services));
    router.add(cancel_job_route(services));
    router.add(inspect_route(services));
    router.add(compare_route(services));
    router.add(list_algorithms_route());
    router.add(health_route());
    router.add(readiness_route(services));
    router.add(metrics_route(services));
    router.add(contract_route());
    return router;
}

}  // namespace coppice
