#include "core/format/gltf/draco.h"

#include <draco/compression/mesh/mesh_edgebreaker_decoder.h>
#include <draco/compression/mesh/mesh_sequential_decoder.h>

#include <algorithm>
#include <array>
#include <memory>

#include "core/format/gltf/draco_header.h"

namespace coppice::gltf {

namespace {

// Stops before values are read that would take more memory than there may be: an attribute may have 255
// components, there may be any number of attributes, and values may take no bits of the stream. What its
// counts alone make the decoder allocate, check_sizes has seen before.
template <typename Decoder>
class BoundedDecoder : public Decoder {
  public:
    explicit BoundedDecoder(uint64_t most_bytes) : most_bytes_(most_bytes) {}

    bool is_too_large() const { return too_large_; }

  protected:
    bool DecodeAllAttributes() override {
        uint64_t stride = 0;
        const draco::PointCloud& points = *Decoder::point_cloud();
        for (int32_t i = 0; i < points.num_attributes(); ++i) stride += decoded_stride(*points.attribute(i));
        too_large_ = stride > 0 && points.num_points() > most_bytes_ / stride;
        return !too_large_ && Decoder::DecodeAllAttributes();
    }

  private:
    // For each point: the value, the integers that it is made of, which stay until all are decoded, and the
    // value's index.
    static uint64_t decoded_stride(const draco::PointAttribute& attribute) {
        return static_cast<uint64_t>(attribute.byte_stride()) +
               sizeof(int32_t) * (uint64_t{attribute.num_components()} + 1);
    }

    uint64_t most_bytes_;
    bool too_large_ = false;
};

template <typename Decoder>
std::unique_ptr<draco::Mesh> decode_with(draco::DecoderBuffer& buffer, uint64_t most_bytes,
                                         const Pointer& where) {
    auto mesh = std::make_unique<draco::Mesh>();
    BoundedDecoder<Decoder> decoder(most_bytes);
    const draco::Status status = decoder.Decode(draco::DecoderOptions(), &buffer, mesh.get());
    require(!decoder.is_too_large(), ErrorCode::asset_too_large, where,
            "{} has attributes in its Draco stream that take more bytes than may be (limit attribute_bytes)",
            where);
    demand(status.ok(), where, "cannot be decoded: {}", status.error_msg_string());
    return mesh;
}

std::unique_ptr<draco::Mesh> decode_mesh(ByteView bytes, DracoMethod method, uint64_t most_bytes,
                                         const Pointer& where) {
    draco::DecoderBuffer buffer;
    buffer.Init(reinterpret_cast<const char*>(bytes.data()), bytes.size());
    return method == DracoMethod::edgebreaker
               ? decode_with<draco::MeshEdgebreakerDecoder>(buffer, most_bytes, where)
               : decode_with<draco::MeshSequentialDecoder>(buffer, most_bytes, where);
}

// What the decoder makes for each set of seams: by corner its vertex and a bit, by vertex four indices. The
// seams split vertices into as many as the accessors have, where these are right.
uint64_t bytes_of_seams(const DracoSizes& sizes, uint64_t vertex_count) {
    constexpr uint64_t for_triangle = 3 * sizeof(uint32_t) + 1, for_vertex = 4 * sizeof(uint32_t);
    return sizes.attribute_data * (sizes.triangles * for_triangle + vertex_count * for_vertex);
}

// What the stream says of itself, before anything is allocated for it. How much its attributes take is only
// known once they are met: BoundedDecoder.
DracoMethod check_sizes(ByteView stream, uint64_t vertex_count, const DracoLimits& limits,
                        const Pointer& where) {
    const auto sizes = draco_sizes(stream);
    demand(sizes.has_value(), where, "is not a Draco stream of triangles");
    require(sizes->triangles <= limits.triangles, ErrorCode::asset_too_large, where,
            "{} has more triangles than are read (limit triangles)", where);
    demand(sizes->vertices <= vertex_count, where,
           "has {} vertices in its accessors, but the Draco stream has {}", vertex_count, sizes->vertices);
    require(bytes_of_seams(*sizes, vertex_count) <= limits.attribute_bytes, ErrorCode::asset_too_large, where,
            "{} has attributes with seams in its Draco stream that take more bytes than may be (limit "
            "attribute_bytes)",
            where);
    return sizes->method;
}

template <typename T>
bool convert(const draco::PointAttribute& attribute, draco::AttributeValueIndex index, uint32_t components,
             std::array<double, 16>& out) {
    std::array<T, 16> values{};
    if (!attribute.ConvertValue<T>(index, static_cast<int8_t>(components), values.data())) return false;
    std::copy_n(values.begin(), components, out.begin());
    return true;
}

// Stored numbers of one vertex, as the accessor's component type has them.
bool stored_value(const draco::PointAttribute& attribute, draco::AttributeValueIndex index,
                  ComponentType type, uint32_t components, std::array<double, 16>& out) {
    switch (type) {
        case ComponentType::int8:
            return convert<int8_t>(attribute, index, components, out);
        case ComponentType::uint8:
            return convert<uint8_t>(attribute, index, components, out);
        case ComponentType::int16:
            return convert<int16_t>(attribute, index, components, out);
        case ComponentType::uint16:
            return convert<uint16_t>(attribute, index, components, out);
        case ComponentType::uint32:
            return convert<uint32_t>(attribute, index, components, out);
        case ComponentType::float32:
            return convert<float>(attribute, index, components, out);
    }
    return false;
}

Bytes stored_values(const draco::Mesh& mesh, const draco::PointAttribute& attribute, const Accessor& as,
                    const Pointer& where) {
    const uint32_t components = as.components();
    demand(attribute.num_components() == static_cast<int>(components), where,
           "has {} components in the Draco stream, but {} in its accessor", attribute.num_components(),
           components);
    Bytes out;
    out.reserve(size_t{mesh.num_points()} * as.element_size());
    std::array<double, 16> value{};
    for (draco::PointIndex point(0); point < mesh.num_points(); ++point) {
        const draco::AttributeValueIndex index = attribute.mapped_index(point);
        demand(index.value() < attribute.size() &&
                   stored_value(attribute, index, as.storage.type, components, value),
               where, "has a Draco value at vertex {} that cannot be read", point.value());
        for (uint32_t c = 0; c < components; ++c) append_component(out, value[c], as.storage.type);
    }
    return out;
}

void read_triangles(const draco::Mesh& mesh, DracoPrimitive& out, const Pointer& where) {
    out.triangles.reserve(3 * size_t{mesh.num_faces()});
    for (draco::FaceIndex face(0); face < mesh.num_faces(); ++face)
        for (const draco::PointIndex& point : mesh.face(face)) {
            demand(point < mesh.num_points(), where,
                   "has vertex {} in triangle {}, but there are {} vertices", point.value(), face.value(),
                   mesh.num_points());
            out.triangles.push_back(point.value());
        }
}

}  // namespace

DracoPrimitive decode_draco(const Parsed& parsed, const Json& primitive, const DracoLimits& limits,
                            const Pointer& primitive_where) {
    const Json& json = *extension(primitive, "KHR_draco_mesh_compression");
    const Pointer where = primitive_where / "extensions" / "KHR_draco_mesh_compression";
    demand(unsigned_at(primitive, "mode", 4) >= 4, where, "is on a primitive of points or lines");
    const ByteView stream = parsed.views[*index_at(json, "bufferView")];
    const auto any_attribute = primitive["attributes"].begin()->get<uint32_t>();
    const DracoMethod method = check_sizes(stream, parsed.accessors[any_attribute].count, limits, where);
    const auto mesh = decode_mesh(stream, method, limits.attribute_bytes, where);
    DracoPrimitive out;
    out.vertex_count = mesh->num_points();
    read_triangles(*mesh, out, where);
    const auto& attributes = json["attributes"].get_ref<const Json::object_t&>();
    out.owned.reserve(attributes.size());
    for (const auto& [name, id] : attributes) {
        const Pointer at = where / "attributes" / name;
        demand(primitive["attributes"].contains(name), at, "is not among the attributes of the primitive");
        const draco::PointAttribute* attribute = mesh->GetAttributeByUniqueId(id.get<uint32_t>());
        demand(attribute != nullptr, at, "is {}, which the Draco stream does not have", id.get<uint32_t>());
        Accessor accessor = parsed.accessors[primitive["attributes"][name].get<uint32_t>()];
        demand(accessor.count == mesh->num_points(), at,
               "has {} vertices in its accessor, but the Draco stream has {}", accessor.count,
               mesh->num_points());
        out.owned.push_back(stored_values(*mesh, *attribute, accessor, at));
        accessor.bytes = out.owned.back();
        accessor.stride = accessor.element_size();
        accessor.sparse = {};
        out.attributes.emplace(name, accessor);
    }
    return out;
}

}  // namespace coppice::gltf
