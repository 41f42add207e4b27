#include "core/base/bytes.h"

#include <bit>
#include <cassert>
#include <cstring>

namespace coppice {

static_assert(std::endian::native == std::endian::little,
              "glTF, GLB, STL and binary PLY are read as they lie");

namespace {

template <typename T>
T load(ByteView bytes, size_t offset) {
    assert(offset + sizeof(T) <= bytes.size());
    T value{};
    std::memcpy(&value, bytes.data() + offset, sizeof(T));
    return value;
}

}  // namespace

ByteView as_bytes(std::string_view text) {
    return std::as_bytes(std::span(text.data(), text.size()));
}

std::string_view as_text(ByteView bytes) {
    return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
}

Bytes to_bytes(std::string_view text) {
    const ByteView view = as_bytes(text);
    return {view.begin(), view.end()};
}

void append(Bytes& out, ByteView more) {
    out.insert(out.end(), more.begin(), more.end());
}

uint32_t load_u32(ByteView bytes, size_t offset) {
    return load<uint32_t>(bytes, offset);
}
uint16_t load_u16(ByteView bytes, size_t offset) {
    return load<uint16_t>(bytes, offset);
}
float load_f32(ByteView bytes, size_t offset) {
    return load<float>(bytes, offset);
}

void append_u32(Bytes& out, uint32_t value) {
    append(out, std::as_bytes(std::span(&value, 1)));
}

}  // namespace coppice
