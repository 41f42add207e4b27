#include "core/format/gltf/read_primitive.h"

#include "core/format/gltf/draco.h"

namespace coppice::gltf {

namespace {

constexpr uint64_t mode_strip = 5;
constexpr uint64_t mode_fan = 6;

// The vertices in drawing order to triangles; what is left over at the end draws nothing.
template <typename VertexAt>
std::vector<uint32_t> unroll(uint64_t mode, uint64_t count, const VertexAt& vertex) {
    std::vector<uint32_t> out;
    if (mode != mode_strip && mode != mode_fan) {
        out.reserve(count / 3 * 3);
        for (uint64_t i = 0; i < count / 3 * 3; ++i) out.push_back(vertex(i));
        return out;
    }
    for (uint64_t i = 2; i < count; ++i) {
        // Every second triangle of a strip runs the other way round.
        const bool odd = mode == mode_strip && i % 2 == 1;
        const uint32_t a = mode == mode_fan ? vertex(i - 1) : vertex(odd ? i - 1 : i - 2);
        const uint32_t b = mode == mode_fan ? vertex(i) : vertex(odd ? i - 2 : i - 1);
        const uint32_t c = mode == mode_fan ? vertex(0) : vertex(i);
        // Repeated indices are how strips jump; they are no triangles.
        if (a != b && b != c && c != a) out.insert(out.end(), {a, b, c});
    }
    return out;
}

std::map<std::string, Accessor> accessors_of(const Parsed& parsed, const Json& map) {
    std::map<std::string, Accessor> out;
    for (const auto& [name, index] : map.items()) out.emplace(name, parsed.accessors[index.get<uint32_t>()]);
    return out;
}

}  // namespace

bool is_triangles(const Json& primitive) {
    return unsigned_at(primitive, "mode", 4) >= 4 && primitive["attributes"].contains("POSITION");
}

PrimitiveData read_primitive(const Parsed& parsed, const Json& primitive, uint64_t triangle_limit,
                             const std::string& where) {
    PrimitiveData data;
    data.attributes = accessors_of(parsed, primitive["attributes"]);
    for (const Json& target : list(primitive, "targets"))
        data.targets.push_back(accessors_of(parsed, target));
    if (extension(primitive, "KHR_draco_mesh_compression") != nullptr) {
        DracoPrimitive decoded = decode_draco(parsed, primitive, triangle_limit, where);
        for (auto& [name, accessor] : decoded.attributes) data.attributes[name] = accessor;
        for (const auto& [name, accessor] : data.attributes)
            demand(accessor.count == decoded.vertex_count, where + "/attributes/" + name,
                   "has {} elements, but the Draco stream has {} vertices", accessor.count,
                   decoded.vertex_count);
        data.vertex_count = decoded.vertex_count;
        data.triangles = std::move(decoded.triangles);
        data.owned = std::move(decoded.owned);
        data.is_draco = true;
        return data;
    }
    data.vertex_count = data.attributes.at("POSITION").count;
    const uint64_t mode = unsigned_at(primitive, "mode", 4);
    const auto indices = index_at(primitive, "indices");
    const uint64_t count = indices ? parsed.accessors[*indices].count : data.vertex_count;
    require((mode == 4 ? count / 3 : count) <= triangle_limit, ErrorCode::asset_too_large, where,
            "{} has more triangles than are read (limit triangles)", where);
    data.triangles =
        indices ? unroll(mode, count, [&](uint64_t i) { return parsed.accessors[*indices].integer(i); })
                : unroll(mode, count, [](uint64_t i) { return static_cast<uint32_t>(i); });
    return data;
}

}  // namespace coppice::gltf
