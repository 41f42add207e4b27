// Accessors as their JSON describes them.
#pragma once

#include "core/format/gltf/accessor.h"
#include "core/format/gltf/json_text.h"

namespace coppice::gltf {

// Type and count, without bytes. accessor: has passed check_schema.
Accessor described(const Json& accessor);

}  // namespace coppice::gltf
