// Scenes as OBJ: expanded, or with instances (.iobj).
#pragma once

#include <cstdint>
#include <vector>

#include "core/base/watch.h"
#include "core/format/archive.h"
#include "core/format/asset.h"
#include "core/scene/scene.h"

namespace coppice {

struct ObjFiles {
    std::vector<NamedFile> files;      // BASE.obj or BASE.iobj, then material libraries and textures
    std::vector<uint64_t> mesh_bytes;  // per unique mesh: bytes of text of its objects
    std::vector<Warning> warnings;     // what OBJ cannot hold
};

// One object per instance, its world transform applied.
ObjFiles write_obj(const Scene& scene, const WriteOptions& options, const Watch& watch);

// Each mesh once, and an #@instance line for each of its instances.
ObjFiles write_iobj(const Scene& scene, const WriteOptions& options, const Watch& watch);

}  // namespace coppice
