// What an OBJ brings along that a Scene does not model, for OBJ -> OBJ.
#pragma once

#include <string>
#include <vector>

#include "core/format/archive.h"
#include "core/scene/scene.h"

namespace coppice {

struct ObjDocument : SourceDocument {
    std::vector<NamedFile> libraries;  // the .mtl files that were there, with the paths that mtllib names
    std::vector<NamedFile> textures;   // that they name and Scene::images does not hold
};

}  // namespace coppice
