// Triangles that no algorithm has a use for.
#pragma once

#include "core/base/watch.h"
#include "core/scene/scene.h"

namespace coppice {

// Drops degenerate and duplicate triangles of every mesh, with what only they use. Each mesh that had some
// gets a warning: repair.degenerate_triangles, repair.duplicate_triangles.
void clean_triangles(Scene& scene, const Watch& watch);

}  // namespace coppice
