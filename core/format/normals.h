// What readers of loose formats do to normals.
#pragma once

#include "core/format/warning_tally.h"
#include "core/mesh/mesh.h"

namespace coppice {

// Makes every used NORMAL unit length, with a warning where it was off by more than text rounding. One
// without a direction (zero, not finite) becomes the mean of its triangles' normals. No attribute NORMAL:
// nothing happens.
void repair_normals(Mesh& mesh, WarningTally& tally);

}  // namespace coppice
