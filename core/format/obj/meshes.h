// From the flat arrays of an OBJ to one mesh per object.
#pragma once

#include <optional>
#include <vector>

#include "core/base/watch.h"
#include "core/format/obj/obj_file.h"
#include "core/mesh/mesh.h"
#include "core/scene/scene.h"

namespace coppice {

struct ObjMeshes {
    std::vector<Mesh> meshes;                             // of the objects that have faces, in order
    std::vector<std::optional<uint32_t>> mesh_of_object;  // none where an object is empty
};

// Positions are welded and keep the file's order, without those that no face uses; wedges are the
// combinations of v, vt and vn, polygons triangulated. Slots are by material and by whether faces have
// texture coordinates and normals. MaterialSlot::material indexes file.materials.
ObjMeshes build_meshes(const ObjFile& file, const Watch& watch, std::vector<Warning>& warnings);

}  // namespace coppice
