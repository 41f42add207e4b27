#include "core/format/utf16.h"

#include <cassert>

namespace coppice {

namespace {

void append_utf8(std::string& out, uint32_t c) {
    const auto put = [&](uint32_t byte) { out += static_cast<char>(byte); };
    if (c < 0x80) return put(c);
    if (c < 0x800) {
        put(0xc0 | c >> 6);
    } else {
        if (c < 0x10000) {
            put(0xe0 | c >> 12);
        } else {
            put(0xf0 | c >> 18);
            put(0x80 | (c >> 12 & 0x3f));
        }
        put(0x80 | (c >> 6 & 0x3f));
    }
    put(0x80 | (c & 0x3f));
}

}  // namespace

bool is_utf16(ByteView bytes) {
    const std::string_view text = as_text(bytes);
    return text.starts_with("\xff\xfe") || text.starts_with("\xfe\xff");
}

std::string utf8_from_utf16(ByteView bytes) {
    assert(is_utf16(bytes));
    const bool big_endian = bytes[0] == std::byte{0xfe};
    const auto unit = [&](size_t at) -> uint32_t {
        const uint32_t value = load_u16(bytes, at);
        return big_endian ? (value >> 8 | value << 8) & 0xffff : value;
    };
    std::string out;
    out.reserve(bytes.size() / 2);
    for (size_t at = 2; at + 2 <= bytes.size(); at += 2) {
        const uint32_t high = unit(at);
        if (high < 0xd800 || high > 0xdfff) {
            append_utf8(out, high);
            continue;
        }
        const uint32_t low = high < 0xdc00 && at + 4 <= bytes.size() ? unit(at + 2) : 0;
        const bool is_pair = low >= 0xdc00 && low <= 0xdfff;
        append_utf8(out, is_pair ? 0x10000 + ((high - 0xd800) << 10) + (low - 0xdc00) : 0xfffd);
        if (is_pair) at += 2;
    }
    return out;
}

}  // namespace coppice
