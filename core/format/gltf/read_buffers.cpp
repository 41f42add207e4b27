#include "core/format/gltf/read_buffers.h"

#include <algorithm>

#include "core/format/gltf/checks.h"
#include "core/format/gltf/data_uri.h"
#include "core/format/gltf/described.h"
#include "core/format/gltf/meshopt.h"

namespace coppice::gltf {

namespace {

// A buffer that only says how large the decompressed views would be; nothing may read it.
bool is_meshopt_fallback(const Json& buffer) {
    const Json* meshopt = extension(buffer, "EXT_meshopt_compression");
    return meshopt != nullptr && meshopt->value("fallback", false);
}

ByteView buffer_bytes(Parsed& parsed, size_t index, const Json& buffer, const Resources& resources) {
    if (!buffer.contains("uri")) return *parsed.binary;
    const auto& uri = buffer.at("uri").get_ref<const std::string&>();
    const Pointer where = pointer("buffers", index, "uri");
    auto data = parse_data_uri(uri, where.text());
    if (!data) return resources.find(uri, where.text());
    demand(data->media_type == "application/octet-stream" || data->media_type == "application/gltf-buffer",
           where,
           "is a data URI of type '{}'; it must be application/octet-stream or application/gltf-buffer",
           data->media_type.substr(0, 60));
    parsed.owned.push_back(std::move(data->bytes));
    return parsed.owned.back();
}

// A part of a view: offset inside it, aligned to its components.
void check_alignment(const Parsed& parsed, uint32_t view, uint64_t offset, ComponentType type,
                     const Pointer& where) {
    const uint32_t size = size_of(type);
    demand(offset % size == 0, where, "has byteOffset {}, which is not a multiple of its component size {}",
           offset, size);
    const uint64_t total = offset + unsigned_at(parsed.json["bufferViews"][view], "byteOffset");
    demand(total % size == 0, where,
           "begins at byte {} of its buffer, which is not a multiple of its component size {}", total, size);
}

void read_base(const Parsed& parsed, const Json& json, Accessor& accessor, const Pointer& where) {
    const auto view = index_at(json, "bufferView");
    const uint64_t offset = unsigned_at(json, "byteOffset");
    if (!view) return demand(!json.contains("byteOffset"), where, "has a byteOffset, but no bufferView");
    const uint64_t declared_stride = unsigned_at(parsed.json["bufferViews"][*view], "byteStride");
    accessor.stride = declared_stride == 0 ? accessor.tight_stride() : declared_stride;
    demand(accessor.stride >= accessor.element_size(), where,
           "has elements of {} bytes, but its buffer view has a byteStride of {}", accessor.element_size(),
           accessor.stride);
    if (accessor.columns > 1)
        demand(offset % 4 == 0, where, "is of matrices and has byteOffset {}, which is not a multiple of 4",
               offset);
    check_alignment(parsed, *view, offset, accessor.storage.type, where);
    const ByteView bytes = parsed.views[*view];
    demand(!bytes.empty(), where, "reads buffer view {}, whose buffer has no uri and so no bytes", *view);
    demand(fits(accessor.count, offset, accessor.stride, accessor.element_size(), bytes.size()), where,
           "has {} elements of {} bytes, {} apart, from byte {} on; its buffer view {} has only {} bytes",
           accessor.count, accessor.element_size(), accessor.stride, offset, *view, bytes.size());
    accessor.bytes = bytes.subspan(offset);
}

ByteView sparse_part(Parsed& parsed, const Json& part, uint64_t count, uint64_t element_size,
                     ComponentType type, const Pointer& where) {
    const uint32_t view = *index_at(part, "bufferView");
    const uint64_t offset = unsigned_at(part, "byteOffset");
    demand(!parsed.json["bufferViews"][view].contains("byteStride"), where,
           "refers to buffer view {}, which has a byteStride; only vertex attributes may", view);
    set_view_usage(parsed, view, ViewUsage::other, where);
    check_alignment(parsed, view, offset, type, where);
    demand(fits(count, offset, element_size, element_size, parsed.views[view].size()), where,
           "has {} elements of {} bytes from byte {} on; its buffer view {} has only {} bytes", count,
           element_size, offset, view, parsed.views[view].size());
    return parsed.views[view].subspan(offset, count * element_size);
}

void read_sparse(Parsed& parsed, const Json& json, Accessor& accessor, const Pointer& where) {
    const auto found = json.find("sparse");
    if (found == json.end()) return;
    const uint64_t count = unsigned_at(*found, "count");
    demand(count <= accessor.count, where / "sparse" / "count", "is {}, but the accessor has {} elements",
           count, accessor.count);
    const auto type = static_cast<ComponentType>(unsigned_at((*found)["indices"], "componentType"));
    accessor.sparse.count = count;
    accessor.sparse.indices = {type, sparse_part(parsed, (*found)["indices"], count, size_of(type), type,
                                                 where / "sparse" / "indices")};
    accessor.sparse.values = sparse_part(parsed, (*found)["values"], count, accessor.tight_stride(),
                                         accessor.storage.type, where / "sparse" / "values");
}

Accessor read_accessor(Parsed& parsed, const Json& json, const Pointer& where) {
    Accessor accessor = described(json);
    demand(!accessor.storage.normalized || size_of(accessor.storage.type) < 4, where / "normalized",
           "is true, but only 8 and 16 bit integers can be normalized");
    for (const char* bound : {"min", "max"})
        demand(!json.contains(bound) || json[bound].size() == accessor.components(), where / bound,
               "has {} numbers; elements of this accessor have {}", list(json, bound).size(),
               accessor.components());
    read_base(parsed, json, accessor, where);
    read_sparse(parsed, json, accessor, where);
    return accessor;
}

}  // namespace

void read_buffers(Parsed& parsed, const Resources& resources, const Watch& watch) {
    const Json& buffers = list(parsed.json, "buffers");
    parsed.owned.reserve(buffers.size() + list(parsed.json, "bufferViews").size());
    for (size_t i = 0; i < buffers.size(); ++i) {
        watch.check();
        // Without a uri it is the BIN chunk, or a placeholder that nothing may read. In a GLB buffer 0 can
        // only be the former, unless it is the space that decompressed views would take.
        const bool is_binary = i == 0 && parsed.binary.has_value();
        if (!buffers[i].contains("uri") && !is_binary) {
            demand(!parsed.is_glb || i > 0 || is_meshopt_fallback(buffers[i]), pointer("buffers", i),
                   "has no uri, so it is the BIN chunk of the GLB, but there is none");
            parsed.buffers.emplace_back();
            continue;
        }
        const ByteView bytes = buffer_bytes(parsed, i, buffers[i], resources);
        const uint64_t declared = unsigned_at(buffers[i], "byteLength");
        demand(bytes.size() >= declared, pointer("buffers", i), "declares {} bytes, but only {} are there",
               declared, bytes.size());
        parsed.buffers.push_back(bytes.first(declared));
    }
}

void read_views(Parsed& parsed, const ReadLimits& limits, const Watch& watch) {
    const Json& views = list(parsed.json, "bufferViews");
    uint64_t decompressed = 0;
    for (size_t i = 0; i < views.size(); ++i) {
        watch.check();
        const Pointer where = pointer("bufferViews", i);
        const uint64_t offset = unsigned_at(views[i], "byteOffset");
        const uint64_t length = unsigned_at(views[i], "byteLength");
        const uint64_t stride = unsigned_at(views[i], "byteStride");
        demand(stride % 4 == 0, where / "byteStride", "is {}, which is not a multiple of 4", stride);
        demand(stride <= length, where / "byteStride", "is {}, but the buffer view has only {} bytes", stride,
               length);
        demand(stride == 0 || unsigned_at(views[i], "target", 34962) == 34962, where / "byteStride",
               "is only for vertex attributes, but the target is {}", unsigned_at(views[i], "target"));
        const uint32_t buffer = *index_at(views[i], "buffer");
        const uint64_t buffer_length = unsigned_at(parsed.json["buffers"][buffer], "byteLength");
        demand(fits(1, offset, 1, length, buffer_length), where,
               "has {} bytes from byte {} on, but buffer {} has only {}", length, offset, buffer,
               buffer_length);
        const uint64_t target = unsigned_at(views[i], "target");
        parsed.view_usages.push_back(target == 34962   ? ViewUsage::vertices
                                     : target == 34963 ? ViewUsage::indices
                                                       : ViewUsage::none);
        if (const Json* meshopt = extension(views[i], "EXT_meshopt_compression")) {
            decompressed += length;
            require(decompressed <= limits.zip_bytes, ErrorCode::asset_too_large, where,
                    "the compressed buffer views hold more than {} bytes (limit zip_bytes)",
                    limits.zip_bytes);
            parsed.owned.push_back(decode_meshopt(parsed, *meshopt, length, where));
            parsed.views.emplace_back(parsed.owned.back());
        } else {
            if (parsed.buffers[buffer].size() != buffer_length) {
                parsed.views.emplace_back();  // of a placeholder: whoever reads it is told so
                continue;
            }
            parsed.views.push_back(parsed.buffers[buffer].subspan(offset, length));
        }
    }
}

void read_accessors(Parsed& parsed, const ReadLimits& limits, const Watch& watch) {
    const Json& accessors = list(parsed.json, "accessors");
    uint64_t without_bytes = 0;
    for (size_t i = 0; i < accessors.size(); ++i) {
        watch.check();
        parsed.accessors.push_back(read_accessor(parsed, accessors[i], pointer("accessors", i)));
        const Accessor& accessor = parsed.accessors.back();
        if (accessor.bytes.empty()) without_bytes += std::min(accessor.count, limits.vertices + 1);
        require(without_bytes <= limits.vertices, ErrorCode::asset_too_large,
                pointer("accessors", i, "count"),
                "the accessors without a buffer view have more than {} elements (limit vertices)",
                limits.vertices);
    }
    parsed.usages.assign(accessors.size(), Usage::none);
    parsed.repairs.assign(accessors.size(), {});
}

}  // namespace coppice::gltf
