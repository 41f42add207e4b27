// Where the objects of an OBJ stand.
#pragma once

#include <cstdint>
#include <optional>
#include <span>

#include "core/format/limits.h"
#include "core/format/obj/obj_file.h"
#include "core/scene/scene.h"

namespace coppice {

// Adds a root node for each #@instance line, grouped by object in the file's order, and one at the identity
// for each object that has none. Throws asset_malformed for an instance of an object that the file lacks,
// asset_too_large where what is drawn exceeds limits.rendered_triangles.
void place_objects(const ObjFile& file, std::span<const std::optional<uint32_t>> mesh_of_object,
                   const ReadLimits& limits, Scene& scene);

}  // namespace coppice
