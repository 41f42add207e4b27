#include "core/format/gltf/image_header.h"

#include "core/base/error.h"
#include "core/format/resources.h"

namespace coppice::gltf {

namespace {

void demand_image(bool condition, const std::string& where, const char* what) {
    require(condition, ErrorCode::asset_malformed, where, "{} is an image that {}", where, what);
}

uint32_t big_endian(ByteView bytes, size_t offset, size_t size) {
    uint32_t value = 0;
    for (size_t i = 0; i < size; ++i) value = value << 8 | static_cast<uint32_t>(bytes[offset + i]);
    return value;
}

// Chunks up to the first one with pixels.
void check_png(ByteView bytes, const std::string& where) {
    size_t offset = 8;
    for (bool first = true;; first = false) {
        demand_image(bytes.size() - offset >= 8, where, "ends before its pixels begin");
        const uint32_t length = big_endian(bytes, offset, 4);
        const std::string_view type = as_text(bytes.subspan(offset + 4, 4));
        demand_image(!first || (type == "IHDR" && length == 13), where, "is a PNG without a header chunk");
        if (type == "IDAT") return;
        demand_image(bytes.size() - offset - 8 >= uint64_t{length} + 4, where,
                     "ends before its pixels begin");
        offset += 12 + size_t{length};
    }
}

// Segments up to the start of a frame.
void check_jpeg(ByteView bytes, const std::string& where) {
    size_t offset = 2;
    for (;;) {
        demand_image(bytes.size() - offset >= 4, where, "ends before its size is told");
        demand_image(bytes[offset] == std::byte{0xFF}, where, "is a JPEG without a marker where one must be");
        const uint32_t marker = big_endian(bytes, offset + 1, 1);
        if (marker == 0xFF) {  // a fill byte
            ++offset;
            continue;
        }
        const uint32_t length = big_endian(bytes, offset + 2, 2);
        demand_image(length >= 2, where, "is a JPEG with a segment of an impossible length");
        const bool is_frame =
            marker >= 0xC0 && marker <= 0xCF && marker != 0xC4 && marker != 0xC8 && marker != 0xCC;
        demand_image(bytes.size() - offset - 2 >= (is_frame ? 8U : length), where,
                     "ends before its size is told");
        if (is_frame)
            return demand_image(length >= 8, where, "is a JPEG with a segment of an impossible length");
        offset += 2 + length;
    }
}

}  // namespace

void check_image_header(ByteView bytes, const std::string& where) {
    const std::string_view type = image_mime_type(bytes);
    if (type == "image/png") check_png(bytes, where);
    if (type == "image/jpeg") check_jpeg(bytes, where);
    if (type == "image/webp") demand_image(bytes.size() >= 30, where, "ends before its size is told");
}

}  // namespace coppice::gltf
