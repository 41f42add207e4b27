// The files that go along with an OBJ: material libraries and textures.
#pragma once

#include <string>
#include <vector>

#include "core/format/archive.h"
#include "core/scene/scene.h"

namespace coppice {

struct ObjCompanions {
    std::vector<std::string>
        material_names;                  // of Scene::materials, as usemtl says them; empty: there are none
    std::vector<std::string> libraries;  // for mtllib lines
    std::vector<NamedFile> files;
    std::vector<Warning> warnings;
};

// Those of an OBJ that was read, unchanged; else a library base_name.mtl with the scene's materials.
ObjCompanions obj_companions(const Scene& scene, const std::string& base_name);

}  // namespace coppice
