// What a scene has and OBJ has not.
#pragma once

#include <vector>

#include "core/scene/scene.h"

namespace coppice {

// A warning "format.lost" for each kind of thing, not for each thing.
std::vector<Warning> obj_losses(const Scene& scene);

}  // namespace coppice
