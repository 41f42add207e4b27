// One byte range of a representation (RFC 9110, section 14).
#pragma once

#include <cstdint>
#include <optional>
#include <string_view>

namespace coppice {

struct ByteRange {
    uint64_t first = 0;
    uint64_t last = 0;  // inclusive

    uint64_t bytes() const { return last - first + 1; }
};

// "bytes=0-99", "bytes=100-", "bytes=-100". None for a unit that is not bytes or what does not parse, which
// RFC 9110 says to ignore. Throws range_not_satisfiable when it begins past the end, and when there are
// several: sending many overlapping ones would let a small request cost a big answer.
std::optional<ByteRange> parse_range(std::string_view header, uint64_t size_bytes);

}  // namespace coppice
