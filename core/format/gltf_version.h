// A look into JSON for what tells glTF, without reading it all.
#pragma once

#include <string>
#include <string_view>

namespace coppice {

// asset.version of JSON text; empty when there is none. Takes any bytes; no recursion, stops at the first it
// finds.
std::string gltf_version(std::string_view json);

}  // namespace coppice
