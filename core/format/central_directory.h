// The one thing about a zip that libzip does not check: whether its entries share bytes (the "better zip
// bomb" of D. Fifield, 2019, gets its ratio from that).
#pragma once

#include "core/base/bytes.h"

namespace coppice {

// Throws asset_malformed when two entries overlap each other or the central directory, or when an entry lies
// outside.
void require_no_overlaps(ByteView zip);

}  // namespace coppice
