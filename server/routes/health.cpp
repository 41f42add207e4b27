// GET /healthz: the process lives. Asks nothing of anything that could wait.
#include "server/routes/routes.h"

namespace coppice {

Route health_route() {
    return {"GET", "/healthz", [](Request&, Response& response) { response.json(200, R"({"status":"ok"})"); },
            true};
}

}  // namespace coppice
