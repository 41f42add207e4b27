// Text that came as UTF-16.
#pragma once

#include <string>

#include "core/base/bytes.h"

namespace coppice {

bool is_utf16(ByteView bytes);  // by its byte order mark, of either order

// Unpaired surrogates become U+FFFD, a last odd byte is dropped. The mark is not kept.
std::string utf8_from_utf16(ByteView bytes);

}  // namespace coppice
