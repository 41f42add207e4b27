// Undoing instancing, where the caller or the format wants it.
#pragma once

#include "core/scene/scene.h"

namespace coppice {

// The instances of every batch as child nodes, in the batch's order and before other children, so that
// instances() lists the same.
void unfold_batches(Scene& scene);

// One copy of its mesh for each instance, nodes kept: the first instance keeps the mesh's index, further
// copies are appended; batches become child nodes. For instancing=expand in glTF.
Scene expand_meshes(const Scene& scene);

// One mesh per instance with its world transform applied, one root node each, at the identity. For plain OBJ.
Scene bake_instances(const Scene& scene);

}  // namespace coppice
