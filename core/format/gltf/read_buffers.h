// From JSON to bytes: buffers, buffer views and accessors, each proven to lie inside what holds it.
#pragma once

#include "core/base/watch.h"
#include "core/format/gltf/parsed.h"
#include "core/format/limits.h"
#include "core/format/resources.h"

namespace coppice::gltf {

// Fills buffers, views and accessors. Throws asset_malformed, asset_too_large, resource_missing,
// resource_forbidden.
void read_buffers(Parsed& parsed, const Resources& resources, const Watch& watch);
void read_views(Parsed& parsed, const ReadLimits& limits, const Watch& watch);  // decompresses meshopt
void read_accessors(Parsed& parsed, const ReadLimits& limits, const Watch& watch);

// What reads the values: sparse indices increase and stay inside, floats are finite (or listed for repair),
// declared min and max are the actual ones (or repaired, with a warning). Needs usages and repairs.
void check_accessor_data(Parsed& parsed, const Watch& watch);

}  // namespace coppice::gltf
