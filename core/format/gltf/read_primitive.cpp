#include "core/format/gltf/read_primitive.h"

#include <algorithm>

#include "core/base/watched_loop.h"

namespace coppice::gltf {

namespace {

constexpr uint64_t mode_strip = 5;
constexpr uint64_t mode_fan = 6;

// The vertices in drawing order to triangles; what is left over at the end draws nothing.
template <typename VertexAt>
std::vector<uint32_t> unroll(uint64_t mode, uint64_t count, const Watch& watch, const VertexAt& vertex) {
    std::vector<uint32_t> out;
    if (mode != mode_strip && mode != mode_fan) {
        out.reserve(count / 3 * 3);
        watched_loop(count / 3 * 3, watch, [&](uint64_t i) { out.push_back(vertex(i)); });
        return out;
    }
    watched_loop(count < 2 ? 0 : count - 2, watch, [&](uint64_t t) {
        const uint64_t i = t + 2;
        // Every second triangle of a strip runs the other way round.
        const bool odd = mode == mode_strip && i % 2 == 1;
        const uint32_t a = mode == mode_fan ? vertex(i - 1) : vertex(odd ? i - 1 : i - 2);
        const uint32_t b = mode == mode_fan ? vertex(i) : vertex(odd ? i - 2 : i - 1);
        const uint32_t c = mode == mode_fan ? vertex(0) : vertex(i);
        // Repeated indices are how strips jump; they are no triangles.
        if (a != b && b != c && c != a) out.insert(out.end(), {a, b, c});
    });
    return out;
}

NamedAccessors accessors_of(const Parsed& parsed, const Json& map) {
    NamedAccessors out;
    out.reserve(map.size());
    for (const auto& [name, index] : map.get_ref<const Json::object_t&>())
        out.push_back({name, &parsed.accessors[index.get<uint32_t>()]});
    return out;
}

// Puts what Draco decoded in the place of the accessors that say what it is.
void decode(const Parsed& parsed, const Json& primitive, const DracoLimits& draco_limits,
            const Pointer& where, PrimitiveData& data) {
    data.decoded = std::make_unique<DracoPrimitive>(decode_draco(parsed, primitive, draco_limits, where));
    for (auto& [name, accessor] : data.attributes) {
        demand(accessor->count == data.decoded->vertex_count, where / "attributes" / name,
               "has {} elements, but the Draco stream has {} vertices", accessor->count,
               data.decoded->vertex_count);
        const auto found = data.decoded->attributes.find(name);
        if (found != data.decoded->attributes.end()) accessor = &found->second;
    }
    data.triangles = std::move(data.decoded->triangles);
}

void unroll_indices(const Parsed& parsed, const Json& primitive, const Watch& watch, PrimitiveData& data) {
    const uint64_t mode = unsigned_at(primitive, "mode", 4);
    if (const auto index = index_at(primitive, "indices")) {
        const Accessor& indices = parsed.accessors[*index];
        data.triangles = unroll(mode, indices.count, watch, [&](uint64_t i) { return indices.integer(i); });
    } else {
        const uint64_t count = parsed.accessors[*index_at(primitive["attributes"], "POSITION")].count;
        data.triangles = unroll(mode, count, watch, [](uint64_t i) { return static_cast<uint32_t>(i); });
    }
}

}  // namespace

bool is_triangles(const Json& primitive) {
    return unsigned_at(primitive, "mode", 4) >= 4 && primitive["attributes"].contains("POSITION");
}

PrimitiveData read_primitive(const Parsed& parsed, const Json& primitive, const DracoLimits& draco_limits,
                             const Pointer& where, const Watch& watch) {
    PrimitiveData data;
    data.attributes = accessors_of(parsed, primitive["attributes"]);
    for (const Json& target : list(primitive, "targets"))
        data.targets.push_back(accessors_of(parsed, target));
    if (extension(primitive, "KHR_draco_mesh_compression") != nullptr)
        decode(parsed, primitive, draco_limits, where, data);
    else
        unroll_indices(parsed, primitive, watch, data);
    const auto positions = std::find_if(data.attributes.begin(), data.attributes.end(),
                                        [](const NamedAccessor& a) { return a.name == "POSITION"; });
    data.positions = positions->accessor;
    data.attributes.erase(positions);
    return data;
}

}  // namespace coppice::gltf
