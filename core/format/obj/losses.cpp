#include "core/format/obj/losses.h"

#include <algorithm>
#include <string_view>

#include "core/format/gltf/beyond_scene.h"
#include "core/format/warning_tally.h"

namespace coppice {

namespace {

constexpr std::string_view code = "format.lost";

bool has_transparent_colors(const Attribute& colors) {
    if (colors.components < 4) return false;
    for (size_t i = 3; i < colors.values.size(); i += colors.components) {
        if (colors.values[i] != 1) return true;
    }
    return false;
}

void note_attribute(const Attribute& attribute, const Mesh& mesh, WarningTally& tally) {
    const std::string_view name = attribute.name;
    if (name == "NORMAL" || name == "TEXCOORD_0") return;
    if (name == "COLOR_0") {
        if (has_transparent_colors(attribute))
            tally.note(code, "OBJ holds no alpha of vertex colours", mesh.name);
        return;
    }
    if (name.starts_with("TEXCOORD_"))
        return tally.note(code, "OBJ holds one set of texture coordinates", mesh.name);
    if (name.starts_with("COLOR_")) return tally.note(code, "OBJ holds one set of vertex colours", mesh.name);
    if (name == "TANGENT") return tally.note(code, "OBJ holds no tangents", mesh.name);
    if (name.starts_with("JOINTS_") || name.starts_with("WEIGHTS_")) {
        return tally.note(code, "OBJ holds no skins: meshes stand in their bind pose", mesh.name);
    }
    tally.note(code, "OBJ holds no attributes of other names", mesh.name + ", " + attribute.name);
}

}  // namespace

std::vector<Warning> obj_losses(const Scene& scene) {
    WarningTally tally;
    for (const Mesh& mesh : scene.meshes) {
        for (const Attribute& attribute : mesh.attributes) note_attribute(attribute, mesh, tally);
        if (!mesh.morph_targets.empty()) tally.note(code, "OBJ holds no morph targets", mesh.name);
    }
    for (const Material& material : scene.materials) {
        for (const TextureUse& use :
             {material.base_color_texture, material.emissive_texture, material.normal_texture}) {
            if (use.image && use.texture_coordinates > 0) {
                tally.note(code, "OBJ textures use the first set of texture coordinates", material.name);
            }
        }
    }
    for (const gltf::Beyond& beyond : gltf::beyond_scene(scene))
        tally.note(code, "OBJ holds no " + beyond.what, beyond.where);
    std::vector<Warning> warnings;
    tally.move_to(warnings);
    return warnings;
}

}  // namespace coppice
