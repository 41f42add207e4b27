#include "core/format/gltf/meshopt.h"

#include <meshoptimizer.h>

namespace coppice::gltf {

namespace {

struct Stream {
    uint64_t count = 0;
    uint64_t stride = 0;
    std::string mode;
    std::string filter;
};

// The extension's own table of what goes with what.
void check(const Stream& stream, uint64_t length, const Pointer& where) {
    const bool is_attributes = stream.mode == "ATTRIBUTES";
    demand(stream.count <= length && stream.count * stream.stride == length, where,
           "has {} elements of {} bytes, but the buffer view has {} bytes", stream.count, stream.stride,
           length);
    if (is_attributes)
        demand(stream.stride % 4 == 0, where, "has byteStride {}; for ATTRIBUTES it must be a multiple of 4",
               stream.stride);
    else
        demand(stream.stride == 2 || stream.stride == 4, where,
               "has byteStride {}; for indices it must be 2 or 4", stream.stride);
    demand(stream.mode != "TRIANGLES" || stream.count % 3 == 0, where,
           "has {} indices; TRIANGLES needs a multiple of 3", stream.count);
    demand(is_attributes || stream.filter == "NONE", where, "has the filter {}, which is only for ATTRIBUTES",
           stream.filter);
    demand(stream.filter != "OCTAHEDRAL" || stream.stride == 4 || stream.stride == 8, where,
           "has byteStride {}; OCTAHEDRAL needs 4 or 8", stream.stride);
    demand(stream.filter != "QUATERNION" || stream.stride == 8, where,
           "has byteStride {}; QUATERNION needs 8", stream.stride);
}

int decode(const Stream& stream, ByteView in, Bytes& out) {
    const auto* data = reinterpret_cast<const unsigned char*>(in.data());
    if (stream.mode == "ATTRIBUTES")
        return meshopt_decodeVertexBuffer(out.data(), stream.count, stream.stride, data, in.size());
    if (stream.mode == "TRIANGLES")
        return meshopt_decodeIndexBuffer(out.data(), stream.count, stream.stride, data, in.size());
    return meshopt_decodeIndexSequence(out.data(), stream.count, stream.stride, data, in.size());
}

// The filters take the elements in fours and may read and write up to the next multiple: there is room for
// that.
void apply_filter(const Stream& stream, Bytes& out) {
    if (stream.filter == "OCTAHEDRAL") meshopt_decodeFilterOct(out.data(), stream.count, stream.stride);
    if (stream.filter == "QUATERNION") meshopt_decodeFilterQuat(out.data(), stream.count, stream.stride);
    if (stream.filter == "EXPONENTIAL") meshopt_decodeFilterExp(out.data(), stream.count, stream.stride);
}

}  // namespace

Bytes decode_meshopt(const Parsed& parsed, const Json& extension, uint64_t length, const Pointer& view) {
    const Pointer where = view / "extensions" / "EXT_meshopt_compression";
    const uint32_t buffer = *index_at(extension, "buffer");
    const uint64_t offset = unsigned_at(extension, "byteOffset");
    const uint64_t size = unsigned_at(extension, "byteLength");
    const ByteView bytes = parsed.buffers[buffer];
    demand(fits(1, offset, 1, size, bytes.size()), where,
           "has {} bytes from byte {} on, but buffer {} has only {}", size, offset, buffer, bytes.size());
    const Stream stream{unsigned_at(extension, "count"), unsigned_at(extension, "byteStride"),
                        text_at(extension, "mode"), extension.value("filter", "NONE")};
    check(stream, length, where);
    // A vertex block needs a bit per byte at least, so a small stream cannot ask for a huge result.
    demand(stream.count / 4096 <= size, where, "has {} bytes for {} elements, which is too few", size,
           stream.count);
    Bytes out(length + 4 * stream.stride);
    demand(decode(stream, bytes.subspan(offset, size), out) == 0, where, "cannot be decompressed");
    apply_filter(stream, out);
    out.resize(length);
    return out;
}

}  // namespace coppice::gltf
