// The contract, as the service serves it.
#pragma once

#include <string_view>

namespace coppice {

// proto/openapi.yaml as JSON; converted when the project is built (cmake/embed_openapi.py).
std::string_view openapi_json();

}  // namespace coppice
