#include "core/format/obj/read_obj.h"

#include <string>
#include <utility>

#include "core/format/iobj/placement.h"
#include "core/format/obj/materials.h"
#include "core/format/obj/meshes.h"
#include "core/format/obj/obj_file.h"
#include "core/format/utf16.h"

namespace coppice {

Scene read_obj(ByteView bytes, const Resources& resources, const ReadLimits& limits, const Watch& watch) {
    const std::string converted = is_utf16(bytes) ? utf8_from_utf16(bytes) : std::string();
    const std::string_view text = converted.empty() ? as_text(bytes) : converted;
    ObjFile file = parse_obj(text, limits, watch.part(0, 0.6));
    require(!file.face_ends.empty() || file.positions.empty(), ErrorCode::asset_unsupported, "",
            "the OBJ has no faces ({} vertices): points, lines and curves alone are not read",
            file.positions.size());
    require(!file.face_ends.empty(), ErrorCode::asset_malformed, "", "the OBJ has no faces and no vertices");
    Scene scene;
    scene.warnings = std::move(file.warnings);
    read_materials(file, resources, limits, scene);
    ObjMeshes objects = build_meshes(file, watch.part(0.6, 1), scene.warnings);
    scene.meshes = std::move(objects.meshes);
    place_objects(file, objects.mesh_of_object, limits, scene);
    return scene;
}

}  // namespace coppice
