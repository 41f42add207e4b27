// GET /v1/algorithms
#include "proto/report.h"
#include "server/routes/routes.h"

namespace coppice {

Route list_algorithms_route() {
    return {"GET", "/v1/algorithms",
            [](Request&, Response& response) { response.json(200, print_algorithms()); }};
}

}  // namespace coppice
