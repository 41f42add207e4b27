// STL, binary and ascii.
#pragma once

#include <string_view>

#include "core/base/bytes.h"
#include "core/base/watch.h"
#include "core/format/limits.h"
#include "core/scene/scene.h"

namespace coppice {

// True when the bytes have the length that their triangle count says: 84 + 50 n.
bool is_binary_stl(ByteView bytes);

// A mesh for each solid (one in a binary file, named file_name without its extension), each placed once at
// the identity. Corners at one place are welded; the normals of facets are not kept, as the triangles tell
// them. Throws asset_malformed with line or byte, asset_too_large.
Scene read_stl(ByteView bytes, std::string_view file_name, const ReadLimits& limits, const Watch& watch);

}  // namespace coppice
