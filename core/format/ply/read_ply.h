// PLY: ascii, binary of either byte order.
#pragma once

#include <string_view>

#include "core/base/bytes.h"
#include "core/base/watch.h"
#include "core/format/limits.h"
#include "core/format/resources.h"
#include "core/scene/scene.h"

namespace coppice {

// One mesh, placed once at the identity, named file_name without its extension. Understands positions,
// normals, texture coordinates of vertices and of corners, colours, polygons, triangle strips, and "comment
// TextureFile" lines; other elements and properties are skipped, point clouds refused. Throws asset_malformed
// with line or byte, asset_too_large. Counts are checked against the bytes before anything is allocated.
Scene read_ply(ByteView bytes, std::string_view file_name, const Resources& resources,
               const ReadLimits& limits, const Watch& watch);

}  // namespace coppice
