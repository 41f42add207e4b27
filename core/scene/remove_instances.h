// Taking instances out of a scene.
#pragma once

#include <span>

#include "core/scene/instance.h"

namespace coppice {

// Takes away what the scene draws there: an entry of its node's batch, or the node's mesh. Nodes and meshes
// stay, and so do their indices. gone: some of what instances() lists, in its order.
void remove_instances(Scene& scene, std::span<const Instance> gone);

}  // namespace coppice
