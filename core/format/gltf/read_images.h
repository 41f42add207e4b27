// Images of a document, as bytes: they are never decoded.
#pragma once

#include "core/format/gltf/parsed.h"
#include "core/format/limits.h"
#include "core/format/resources.h"

namespace coppice::gltf {

// Fills Parsed::images. Checks that declared and actual type agree and that the header is whole.
// Throws asset_malformed, resource_missing, resource_forbidden.
void read_images(Parsed& parsed, const Resources& resources, const ReadLimits& limits);

}  // namespace coppice::gltf
