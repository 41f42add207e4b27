#include "core/format/gltf/draco_header.h"

#include <draco/compression/point_cloud/point_cloud_decoder.h>
#include <draco/core/varint_decoding.h>
#include <draco/metadata/metadata_decoder.h>

namespace coppice::gltf {

namespace {

constexpr uint16_t version_of(unsigned major, unsigned minor) {
    return static_cast<uint16_t>(major << 8 | minor);
}

// Reads a count as the stream's version has it.
bool read_count(draco::DecoderBuffer& buffer, uint16_t varint_since, uint32_t& count) {
    return buffer.bitstream_version() < varint_since ? buffer.Decode(&count)
                                                     : draco::DecodeVarint(&count, &buffer);
}

bool skip_metadata(draco::DecoderBuffer& buffer, const draco::DracoHeader& header) {
    if (buffer.bitstream_version() < version_of(1, 3) || (header.flags & METADATA_FLAG_MASK) == 0)
        return true;
    draco::GeometryMetadata metadata;
    return draco::MetadataDecoder().DecodeGeometryMetadata(&buffer, &metadata);
}

bool read_edgebreaker_sizes(draco::DecoderBuffer& buffer, DracoSizes& sizes) {
    uint8_t traversal = 0;
    uint32_t split_vertices = 0;
    constexpr uint16_t varint_since = version_of(2, 0);
    if (!buffer.Decode(&traversal)) return false;
    if (buffer.bitstream_version() < version_of(2, 2) && !read_count(buffer, varint_since, split_vertices))
        return false;
    return read_count(buffer, varint_since, sizes.vertices) &&
           read_count(buffer, varint_since, sizes.triangles) && buffer.Decode(&sizes.attribute_data);
}

bool read_sequential_sizes(draco::DecoderBuffer& buffer, DracoSizes& sizes) {
    constexpr uint16_t varint_since = version_of(2, 2);
    return read_count(buffer, varint_since, sizes.triangles) &&
           read_count(buffer, varint_since, sizes.vertices);
}

// The decoders themselves do not look at it.
std::optional<DracoMethod> method_of(const draco::DracoHeader& header) {
    switch (header.encoder_method) {
        case draco::MESH_SEQUENTIAL_ENCODING:
            return DracoMethod::sequential;
        case draco::MESH_EDGEBREAKER_ENCODING:
            return DracoMethod::edgebreaker;
        default:
            return std::nullopt;
    }
}

}  // namespace

std::optional<DracoSizes> draco_sizes(ByteView stream) {
    draco::DecoderBuffer buffer;
    buffer.Init(reinterpret_cast<const char*>(stream.data()), stream.size());
    draco::DracoHeader header;
    if (!draco::PointCloudDecoder::DecodeHeader(&buffer, &header).ok()) return std::nullopt;
    const auto method = method_of(header);
    if (header.encoder_type != draco::TRIANGULAR_MESH || !method) return std::nullopt;
    buffer.set_bitstream_version(version_of(header.version_major, header.version_minor));
    if (!skip_metadata(buffer, header)) return std::nullopt;
    DracoSizes sizes{.method = *method};
    const bool is_read = sizes.method == DracoMethod::edgebreaker ? read_edgebreaker_sizes(buffer, sizes)
                                                                  : read_sequential_sizes(buffer, sizes);
    return is_read ? std::optional(sizes) : std::nullopt;
}

}  // namespace coppice::gltf
