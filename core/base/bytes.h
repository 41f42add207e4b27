// Raw bytes and bounds-checked little-endian reads from them.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string_view>
#include <vector>

namespace coppice {

using Bytes = std::vector<std::byte>;
using ByteView = std::span<const std::byte>;

ByteView as_bytes(std::string_view text);
std::string_view as_text(ByteView bytes);  // the same memory, no check of its encoding
Bytes to_bytes(std::string_view text);     // a copy
void append(Bytes& out, ByteView more);

// Little-endian, at any alignment. The caller has checked that offset + 4 (2) <= bytes.size().
uint32_t load_u32(ByteView bytes, size_t offset);
uint16_t load_u16(ByteView bytes, size_t offset);
float load_f32(ByteView bytes, size_t offset);
void append_u32(Bytes& out, uint32_t value);

}  // namespace coppice
