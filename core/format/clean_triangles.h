// Triangles that no algorithm has a use for.
#pragma once

#include <string>
#include <vector>

#include "core/base/watch.h"
#include "core/scene/scene.h"

namespace coppice {

// Drops degenerate and duplicate triangles of every mesh, with what only they use. Each mesh that had some
// gets a warning: repair.degenerate_triangles, repair.duplicate_triangles.
void clean_triangles(Scene& scene, const Watch& watch);

// The same for one mesh: "3 degenerate triangles of NAME were dropped", at `where`.
void clean_triangles(Mesh& mesh, const std::string& name, const std::string& where,
                     std::vector<Warning>& warnings, const Watch& watch);

}  // namespace coppice
