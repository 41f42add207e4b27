#include "core/format/gltf/glb.h"

#include "core/base/error.h"
#include "core/base/watched_loop.h"
#include "core/format/gltf/gltf.h"

namespace coppice {

namespace {

constexpr uint32_t glb_magic = 0x46546C67;     // "glTF"
constexpr uint32_t json_chunk = 0x4E4F534A;    // "JSON"
constexpr uint32_t binary_chunk = 0x004E4942;  // "BIN\0"
constexpr size_t header_size = 12;
constexpr size_t chunk_header_size = 8;

template <typename... Args>
void demand(bool condition, size_t offset, fmt::format_string<Args...> message, Args&&... args) {
    if (!condition)
        fail(ErrorCode::asset_malformed, fmt::format("byte {}", offset),
             fmt::format(message, std::forward<Args>(args)...));
}

}  // namespace

bool is_glb(ByteView bytes) {
    return bytes.size() >= 4 && load_u32(bytes, 0) == glb_magic;
}

namespace gltf {

namespace {

void check_header(ByteView bytes) {
    demand(bytes.size() >= header_size, 0, "a GLB has a header of {} bytes, but the file has {}", header_size,
           bytes.size());
    demand(load_u32(bytes, 0) == glb_magic, 0, "a GLB begins with 'glTF', but this begins with 0x{:08x}",
           load_u32(bytes, 0));
    const uint32_t version = load_u32(bytes, 4);
    require(version != 1, ErrorCode::asset_unsupported, "byte 4",
            "this is a binary glTF 1.0; glTF 2.0 is read");
    demand(version == 2, 4, "the GLB version is {}; it must be 2", version);
    const uint32_t length = load_u32(bytes, 8);
    demand(length <= bytes.size(), 8, "the GLB header declares {} bytes, but the file has {}", length,
           bytes.size());
    demand(length >= header_size + chunk_header_size, 8, "the GLB has no chunk: {} bytes are too few",
           length);
}

}  // namespace

GlbChunks parse_glb(ByteView bytes) {
    check_header(bytes);
    bytes = bytes.first(load_u32(bytes, 8));  // what follows is no part of it
    GlbChunks chunks;
    size_t offset = header_size;
    for (size_t index = 0; offset < bytes.size(); ++index) {
        demand(bytes.size() - offset >= chunk_header_size, offset, "the header of chunk {} is cut off",
               index);
        const uint32_t length = load_u32(bytes, offset);
        const uint32_t type = load_u32(bytes, offset + 4);
        demand(length % 4 == 0, offset, "chunk {} has {} bytes, which is not a multiple of 4", index, length);
        offset += chunk_header_size;
        demand(length <= bytes.size() - offset, offset, "chunk {} has {} bytes, but only {} are left", index,
               length, bytes.size() - offset);
        const ByteView data = bytes.subspan(offset, length);
        if (index == 0) {
            demand(type == json_chunk, offset - 4, "the first chunk must be JSON, but it is 0x{:08x}", type);
            demand(length > 0, offset, "the JSON chunk is empty");
            chunks.json = data;
        } else if (type == binary_chunk) {
            demand(index == 1, offset - 4, "the BIN chunk must be the second one, but it is chunk {}", index);
            chunks.binary = data;
        } else {
            demand(type != json_chunk, offset - 4, "chunk {} is a second JSON chunk", index);
        }
        offset += length;
    }
    return chunks;
}

Bytes print_glb(std::string_view json, ByteView binary, const Watch& watch) {
    const auto padded = [](size_t size) { return (size + 3) / 4 * 4; };
    const size_t total = header_size + chunk_header_size + padded(json.size()) +
                         (binary.empty() ? 0 : chunk_header_size + padded(binary.size()));
    require(total <= UINT32_MAX, ErrorCode::asset_too_large, "",
            "the result has {} bytes; a GLB holds at most 4 GiB", total);
    Bytes out;
    out.reserve(total);
    append_u32(out, glb_magic);
    append_u32(out, 2);
    append_u32(out, static_cast<uint32_t>(total));
    append_u32(out, static_cast<uint32_t>(padded(json.size())));
    append_u32(out, json_chunk);
    watched_append(out, as_bytes(json), watch);
    out.resize(header_size + chunk_header_size + padded(json.size()), std::byte{' '});
    if (binary.empty()) return out;
    append_u32(out, static_cast<uint32_t>(padded(binary.size())));
    append_u32(out, binary_chunk);
    watched_append(out, binary, watch);
    out.resize(total);
    return out;
}

}  // namespace gltf

}  // namespace coppice
