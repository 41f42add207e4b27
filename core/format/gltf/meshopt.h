// EXT_meshopt_compression: buffer views as meshoptimizer's streams.
#pragma once

#include "core/format/gltf/parsed.h"

namespace coppice::gltf {

// The decompressed bytes of a buffer view of `length` bytes. Throws asset_malformed.
Bytes decode_meshopt(const Parsed& parsed, const Json& extension, uint64_t length, const Pointer& where);

}  // namespace coppice::gltf
