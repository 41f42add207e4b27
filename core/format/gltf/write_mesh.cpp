#include "core/format/gltf/write_mesh.h"

#include <algorithm>
#include <string_view>
#include <unordered_map>

#include "core/base/watched_loop.h"
#include "core/format/gltf/legal_values.h"
#include "core/format/gltf/parsed.h"
#include "core/format/gltf/read_primitive.h"
#include "core/format/gltf/semantics.h"
#include "core/format/gltf/slot_geometry.h"

namespace coppice::gltf {

namespace {

// Extensions of a primitive that describe its triangles as they were, and mean nothing for others.
constexpr const char* geometry_extensions[] = {"FB_ngon_encoding", "CESIUM_primitive_outline"};

// Owns the bytes that an accessor is a window into.
struct Values {
    Bytes bytes;
    Accessor accessor;
};

template <typename ValueAt>
Values encode_values(uint32_t components, Storage storage, uint64_t count, const Watch& watch,
                     const ValueAt& value) {
    Values out;
    out.accessor.storage = storage;
    out.accessor.count = count;
    if (components == 9 || components == 16) out.accessor.columns = components == 9 ? 3 : 4;
    out.accessor.rows = components / out.accessor.columns;
    out.bytes.reserve(count * out.accessor.tight_stride());
    watched_loop(count, watch, [&](size_t i) {
        for (uint32_t c = 0; c < components; ++c) {
            append_component(out.bytes, encoded(value(i, c), storage), storage.type);
            const bool ends_column = out.accessor.columns > 1 && (c + 1) % out.accessor.rows == 0;
            while (ends_column && out.bytes.size() % 4 != 0) out.bytes.push_back(std::byte{0});
        }
    });
    out.accessor.bytes = out.bytes;
    out.accessor.stride = out.accessor.tight_stride();
    return out;
}

// What it was stored as, where glTF allows that here; floats otherwise.
Storage allowed_storage(std::string_view name, uint32_t components, Storage storage, bool is_delta,
                        bool quantization) {
    const Semantic semantic = parse_attribute_name(name).semantic;
    Accessor probe;
    probe.rows = components;
    probe.storage = storage;
    if (components <= 4 && is_valid_format(semantic, probe, is_delta, quantization)) return storage;
    if (semantic == Semantic::joints) return {ComponentType::uint16, false};
    return {};
}

class PrimitiveWriter {
  public:
    PrimitiveWriter(const Mesh& mesh, MeshContext& context) : mesh_(mesh), context_(context) {
        for (size_t a = 0; a < mesh.attributes.size(); ++a) attributes_.emplace(mesh.attributes[a].name, a);
    }

    // source: the primitive's object in the source, or an empty object.
    Json write(uint32_t slot, const SlotGeometries::Slot& geometry, Json source) {
        Json primitive = std::move(source);
        for (const char* replaced : {"attributes", "indices", "targets", "mode", "material"})
            primitive.erase(replaced);
        drop_extensions(primitive);
        if (mesh_.slots[slot].material) primitive["material"] = *mesh_.slots[slot].material;
        const auto [buffer, is_new] = buffers_.try_emplace(geometry.wedges);
        if (is_new) buffer->second = write_buffer(slot, *geometry.wedges);
        primitive["attributes"] = buffer->second.attributes;
        if (!buffer->second.targets.empty()) primitive["targets"] = buffer->second.targets;
        primitive["indices"] = indices(geometry);
        return primitive;
    }

  private:
    struct VertexBuffer {
        Json attributes = Json::object();
        Json targets = Json::array();
    };

    // slot: one of those that use the buffer; all have the same attributes.
    VertexBuffer write_buffer(uint32_t slot, const std::vector<uint32_t>& wedges) {
        VertexBuffer buffer;
        buffer.attributes["POSITION"] = positions(wedges);
        for (size_t a = 0; a < mesh_.attributes.size(); ++a) {
            const Attribute& attribute = mesh_.attributes[a];
            if (!mesh_.slots[slot].has(a) || !is_storable(attribute)) continue;
            buffer.attributes[attribute.name] = values(attribute, wedges, false);
        }
        for (const MorphTarget& target : mesh_.morph_targets)
            buffer.targets.push_back(deltas(target, slot, wedges));
        return buffer;
    }

    static bool is_storable(const Attribute& attribute) {
        const uint32_t n = attribute.components;
        return parse_attribute_name(attribute.name).semantic != Semantic::invalid &&
               ((n >= 1 && n <= 4) || n == 9 || n == 16);
    }

    void drop_extensions(Json& primitive) {
        if (!primitive.contains("extensions")) return;
        Json& extensions = primitive["extensions"];
        extensions.erase("KHR_draco_mesh_compression");
        for (const char* name : geometry_extensions)
            if (extensions.erase(name) > 0) context_.dropped.insert(name);
        if (extensions.empty()) primitive.erase("extensions");
    }

    uint32_t positions(const std::vector<uint32_t>& wedges) {
        const Storage storage =
            allowed_storage("POSITION", 3, mesh_.position_storage, false, context_.quantization);
        const Values encoded_positions =
            encode_values(3, storage, wedges.size(), context_.watch, [&](uint64_t i, uint32_t c) -> double {
                const Vec3f& p = mesh_.positions[mesh_.wedge_vertex[wedges[i]]];
                return c == 0 ? p.x : c == 1 ? p.y : p.z;
            });
        return context_.buffer.add(encoded_positions.accessor, BufferWriter::Kind::vertices, true);
    }

    uint32_t values(const Attribute& attribute, const std::vector<uint32_t>& wedges, bool is_delta) {
        const Storage storage = allowed_storage(attribute.name, attribute.components, attribute.storage,
                                                is_delta, context_.quantization);
        const Values encoded_values =
            encode_values(attribute.components, storage, wedges.size(), context_.watch,
                          [&](uint64_t i, uint32_t c) -> double {
                              return attribute.values[size_t{wedges[i]} * attribute.components + c];
                          });
        return context_.buffer.add(encoded_values.accessor, BufferWriter::Kind::vertices,
                                   is_delta && attribute.name == "POSITION");
    }

    Json deltas(const MorphTarget& target, uint32_t slot, const std::vector<uint32_t>& wedges) {
        Json out = Json::object();
        for (const Attribute& delta : target.deltas) {
            const auto base = attributes_.find(delta.name);
            const bool has_base = delta.name == "POSITION" ||
                                  (base != attributes_.end() && mesh_.slots[slot].has(base->second));
            if (has_base && is_storable(delta)) out[delta.name] = values(delta, wedges, true);
        }
        // A target without any delta is not allowed; one of zeros is.
        if (out.empty()) {
            Attribute zeros{"POSITION", 3, {}, std::vector<float>(3 * mesh_.wedge_count())};
            out["POSITION"] = values(zeros, wedges, true);
        }
        return out;
    }

    uint32_t indices(const SlotGeometries::Slot& geometry) {
        const bool is_short = geometry.wedges->size() <= largest_short_count;
        const Values encoded_indices = encode_values(
            1, {is_short ? ComponentType::uint16 : ComponentType::uint32, false}, geometry.indices.size(),
            context_.watch, [&](uint64_t i, uint32_t) -> double { return geometry.indices[i]; });
        return context_.buffer.add(encoded_indices.accessor, BufferWriter::Kind::indices, false);
    }

    const Mesh& mesh_;
    MeshContext& context_;
    std::unordered_map<std::string_view, size_t> attributes_;                 // of the mesh, by name
    std::unordered_map<const std::vector<uint32_t>*, VertexBuffer> buffers_;  // written, by their wedges
};

// Points, lines, and what has no positions: as it was, with accessors of the result.
Json pass_primitive(Json primitive, const MeshContext& context) {
    for (auto& [name, index] : primitive["attributes"].items())
        index = context.pass_accessor(index.get<uint32_t>());
    if (primitive.contains("targets"))
        for (Json& target : primitive["targets"])
            for (auto& [name, index] : target.items()) index = context.pass_accessor(index.get<uint32_t>());
    if (primitive.contains("indices"))
        primitive["indices"] = context.pass_accessor(primitive["indices"].get<uint32_t>());
    return primitive;
}

// What stands in for a mesh of which no triangle is left, so that nodes, materials and animations keep what
// they name.
Mesh placeholder(const Mesh& mesh) {
    Mesh out;
    out.slots =
        mesh.slots.empty() ? std::vector<MaterialSlot>(1) : std::vector<MaterialSlot>(1, mesh.slots.front());
    out.slots[0].has_attribute.clear();
    out.positions = {mesh.positions.empty() ? Vec3f{} : mesh.positions.front()};
    out.wedge_vertex = {0};
    for (const Attribute& attribute : mesh.attributes) {
        Attribute one{attribute.name, attribute.components, attribute.storage,
                      std::vector<float>(attribute.components, 0.0F)};
        if (attribute.name == "WEIGHTS_0") one.values[0] = 1;
        if (attribute.name == "NORMAL") one.values[2] = 1;
        if (attribute.name == "TANGENT") one.values = {1, 0, 0, 1};
        out.attributes.push_back(std::move(one));
    }
    for (const MorphTarget& target : mesh.morph_targets) {
        out.morph_targets.emplace_back();
        for (const Attribute& delta : target.deltas)
            out.morph_targets.back().deltas.push_back(
                {delta.name, delta.components, delta.storage, std::vector<float>(delta.components, 0.0F)});
    }
    out.triangles = {0, 0, 0};
    out.triangle_slot = {0};
    return out;
}

Json source_primitive(const Json* source, const MaterialSlot& slot) {
    if (source == nullptr || !slot.source_primitive ||
        *slot.source_primitive >= (*source)["primitives"].size())
        return Json::object();
    return (*source)["primitives"][*slot.source_primitive];
}

}  // namespace

Json write_mesh(const Mesh& mesh, const Json* source, MeshContext& context) {
    Json json = source != nullptr ? *source : Json::object();
    json.erase("primitives");
    if (!mesh.name.empty()) json["name"] = mesh.name;
    Mesh legal = without_triangles(mesh, context.watch);
    legal.triangles = watched_copy(mesh.triangles, context.watch);
    legal.triangle_slot = watched_copy(mesh.triangle_slot, context.watch);
    make_legal(legal, context.watch);
    Json primitives = Json::array();
    const auto write_slots = [&](const Mesh& of) {
        PrimitiveWriter writer(of, context);
        const SlotGeometries geometries(of, context.watch);
        for (uint32_t slot = 0; slot < of.slots.size(); ++slot)
            if (!geometries[slot].indices.empty())
                primitives.push_back(
                    writer.write(slot, geometries[slot], source_primitive(source, of.slots[slot])));
    };
    write_slots(legal);
    if (source != nullptr)
        for (const Json& primitive : (*source)["primitives"])
            if (!is_triangles(primitive)) primitives.push_back(pass_primitive(primitive, context));
    if (primitives.empty()) write_slots(placeholder(mesh));
    json["primitives"] = std::move(primitives);
    return json;
}

}  // namespace coppice::gltf
