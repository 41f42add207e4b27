// Holds a document against the schemas.
#pragma once

#include "core/base/watch.h"
#include "core/format/gltf/json_text.h"

namespace coppice::gltf {

// Types, ranges, required properties, references to arrays of the root, places and declarations of
// extensions. Integers that were written with a fraction of zero become integers. Throws asset_malformed with
// a JSON pointer.
void check_schema(Json& document, const Watch& watch);

}  // namespace coppice::gltf
