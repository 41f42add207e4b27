// From the names in an OBJ to materials and images of a scene.
#pragma once

#include "core/format/obj/obj_file.h"
#include "core/format/resources.h"
#include "core/scene/scene.h"

namespace coppice {

// Fills scene.materials (one per name in file.materials, in that order), scene.images and scene.source.
// Libraries and textures are optional in OBJ: what is missing, or lies outside the upload, is a warning.
void read_materials(const ObjFile& file, const Resources& resources, const ReadLimits& limits, Scene& scene);

}  // namespace coppice
