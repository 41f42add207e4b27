// GET /openapi.json
#include "proto/openapi.h"
#include "server/routes/routes.h"

namespace coppice {

Route contract_route() {
    return {"GET", "/openapi.json",
            [](Request&, Response& response) { response.json(200, std::string(openapi_json())); }};
}

}  // namespace coppice
