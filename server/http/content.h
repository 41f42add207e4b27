// Bytes that are read while they are sent: nothing is held whole.
#pragma once

#include <cstdint>
#include <functional>
#include <span>
#include <string>
#include <vector>

#include "server/http/range.h"

namespace coppice {

struct Content {
    uint64_t bytes = 0;
    // Fills `into` from `offset`; fewer bytes than asked for only at the end.
    std::function<size_t(uint64_t offset, std::span<std::byte> into)> read;
};

Content content_of(std::string text);
Content part_of(Content whole, const ByteRange& range);  // which lies in it
Content join(std::vector<Content> pieces);               // one after the other

}  // namespace coppice
