// The text that begins a PLY file and says what follows.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/base/bytes.h"

namespace coppice {

enum class PlyType : uint8_t { int8, uint8, int16, uint16, int32, uint32, float32, float64 };

size_t size_of(PlyType type);
bool is_integer(PlyType type);
double largest(PlyType type);  // of an integer type; 1 for the others

struct PlyProperty {
    std::string name;
    PlyType type = PlyType::float32;         // of the value, or of a list's items
    std::optional<PlyType> list_count = {};  // of a list: the type of its length
};

struct PlyElement {
    std::string name;
    uint64_t count = 0;
    std::vector<PlyProperty> properties = {};

    // The first of that name; none when there is no such.
    std::optional<size_t> find(std::string_view property) const;
    size_t smallest_row_bytes() const;  // in a binary file, with empty lists
};

enum class PlyEncoding { ascii, little_endian, big_endian };

struct PlyHeader {
    PlyEncoding encoding = PlyEncoding::ascii;
    std::vector<PlyElement> elements = {};
    std::vector<std::string> texture_files = {};  // of "comment TextureFile" lines
    size_t bytes = 0;                             // where the body begins
    uint64_t lines = 0;                           // how many the header has
};

// Lines end as the first one does: \n, \r\n or \r. Throws asset_malformed with line and column.
PlyHeader parse_ply_header(ByteView bytes);

}  // namespace coppice
