// OBJ, plain and instanced (.iobj).
#pragma once

#include "core/base/bytes.h"
#include "core/base/watch.h"
#include "core/format/limits.h"
#include "core/format/resources.h"
#include "core/scene/scene.h"

namespace coppice {

// Each `o` is one mesh (groups are not objects), placed once at the identity, or where #@instance lines say.
// Throws asset_malformed with line and column (a file without triangles, too), asset_too_large.
Scene read_obj(ByteView bytes, const Resources& resources, const ReadLimits& limits, const Watch& watch);

}  // namespace coppice
