// Material libraries of OBJ.
#pragma once

#include <cstdint>
#include <map>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "core/format/warning_tally.h"
#include "core/scene/scene.h"

namespace coppice {

struct MtlMaterial {
    Material material;               // without textures
    std::string base_color_path;     // map_Kd, as written; empty: none
    std::string emissive_path;       // map_Ke
    std::string normal_path;         // norm, map_Bump, bump
    std::vector<std::string> paths;  // of all maps, these included, in order
};

// Lenient, as materials are no reason to refuse geometry: what does not parse is skipped with a warning.
// library: the file's name, for where.
std::vector<MtlMaterial> parse_mtl(std::string_view text, std::string_view library, WarningTally& tally);

// Text of a library for these materials. names: of each; image_paths: of Scene::images, where the library
// finds them.
std::string print_mtl(std::span<const Material> materials, std::span<const std::string> names,
                      std::span<const std::string> image_paths);

}  // namespace coppice
