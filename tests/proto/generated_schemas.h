// The part of the contract that follows from the code: algorithms, error codes, stop reasons.
#pragma once

#include <string>

namespace coppice {

// YAML, as it stands in proto/openapi.yaml between the markers; indented by four.
std::string generated_schemas();

}  // namespace coppice
