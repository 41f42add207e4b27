// What a glTF document has and a Scene has not: for writers of other formats, which cannot pass it through.
#pragma once

#include <string>
#include <vector>

#include "core/scene/scene.h"

namespace coppice::gltf {

struct Beyond {
    std::string what;   // in the plural: "cameras"
    std::string where;  // of the first one
};

// Each kind once; nothing for a scene that did not come from glTF.
std::vector<Beyond> beyond_scene(const Scene& scene);

}  // namespace coppice::gltf
