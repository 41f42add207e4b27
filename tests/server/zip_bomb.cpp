#include "tests/server/zip_bomb.h"

#include <zlib.h>

#include <cstdint>
#include <stdexcept>

namespace coppice::test {
namespace {

void append_u16(std::string& out, uint32_t value) {
    out += static_cast<char>(value & 0xff);
    out += static_cast<char>(value >> 8 & 0xff);
}

void append_u32(std::string& out, uint32_t value) {
    append_u16(out, value & 0xffff);
    append_u16(out, value >> 16);
}

}  // namespace

std::string zip_bomb() {
    const std::string name = "scene.obj";
    const std::string megabyte(1 << 20, ' ');
    constexpr uint32_t megabytes = 20;
    std::string packed(1 << 20, '\0');
    z_stream stream{};
    if (deflateInit2(&stream, 9, Z_DEFLATED, -15, 9, Z_DEFAULT_STRATEGY) != Z_OK)
        throw std::runtime_error("zlib");
    stream.next_out = reinterpret_cast<Bytef*>(packed.data());
    stream.avail_out = static_cast<uInt>(packed.size());
    uLong crc = crc32(0, nullptr, 0);
    for (uint32_t i = 0; i < megabytes; ++i) {
        const auto* bytes = reinterpret_cast<const Bytef*>(megabyte.data());
        crc = crc32(crc, bytes, static_cast<uInt>(megabyte.size()));
        stream.next_in = const_cast<Bytef*>(bytes);
        stream.avail_in = static_cast<uInt>(megabyte.size());
        deflate(&stream, i + 1 == megabytes ? Z_FINISH : Z_NO_FLUSH);
    }
    packed.resize(stream.total_out);
    deflateEnd(&stream);

    const auto describe = [&](std::string& out) {
        append_u16(out, 20);  // version needed
        append_u16(out, 0);
        append_u16(out, 8);  // deflate
        append_u32(out, 0x58210000);
        append_u32(out, static_cast<uint32_t>(crc));
        append_u32(out, static_cast<uint32_t>(packed.size()));
        append_u32(out, megabytes << 20);
        append_u16(out, static_cast<uint32_t>(name.size()));
        append_u16(out, 0);
    };
    std::string zip = "PK\x03\x04";
    describe(zip);
    zip += name + packed;
    const auto directory = static_cast<uint32_t>(zip.size());
    zip += "PK\x01\x02";
    append_u16(zip, 20);
    describe(zip);
    zip += std::string(10, '\0');
    append_u32(zip, 0);
    zip += name;
    const auto directory_bytes = static_cast<uint32_t>(zip.size()) - directory;
    zip += std::string("PK\x05\x06") + std::string(4, '\0');
    append_u16(zip, 1);
    append_u16(zip, 1);
    append_u32(zip, directory_bytes);
    append_u32(zip, directory);
    append_u16(zip, 0);
    return zip;
}

}  // namespace coppice::test
