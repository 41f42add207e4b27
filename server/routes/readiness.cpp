// GET /readyz: the service can take work, or 503 and why not.
#include "core/base/error.h"
#include "server/http/answer.h"
#include "server/routes/routes.h"

namespace coppice {

Route readiness_route(Services& services) {
    return {"GET", "/readyz",
            [&services](Request&, Response& response) {
                try {
                    require_room(services);
                    services.blobs.check_writable();
                    response.json(200, R"({"status":"ok"})");
                } catch (const Error& error) {
                    set_problem(response, to_problem(error), 503);
                }
            },
            true};
}

}  // namespace coppice
