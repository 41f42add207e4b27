#include <algorithm>
#include <array>
#include <map>

#include "core/format/gltf/checks.h"
#include "core/format/gltf/semantics.h"

namespace coppice::gltf {

namespace {

class MeshCheck {
  public:
    MeshCheck(Parsed& parsed, const Watch& watch)
        : parsed_(parsed),
          watch_(watch),
          vertex_accessor_(parsed.views.size()),
          quantization_(uses_quantization(parsed.json)) {}

    void mesh(size_t index) {
        const Json& mesh = parsed_.json["meshes"][index];
        const Json& primitives = mesh["primitives"];
        const size_t targets = list(primitives[0], "targets").size();
        for (size_t p = 0; p < primitives.size(); ++p) {
            watch_.check();
            const Pointer where = pointer("meshes", index, "primitives", p);
            demand(list(primitives[p], "targets").size() == targets, where / "targets",
                   "has {} morph targets, but primitive 0 has {}", list(primitives[p], "targets").size(),
                   targets);
            primitive(primitives[p], where);
        }
        if (mesh.contains("weights"))
            demand(mesh["weights"].size() == targets, pointer("meshes", index, "weights"),
                   "has {} numbers, but the mesh has {} morph targets", mesh["weights"].size(), targets);
    }

  private:
    static bool uses_quantization(const Json& document) {
        const Json& used = list(document, "extensionsUsed");
        return std::find(used.begin(), used.end(), "KHR_mesh_quantization") != used.end();
    }

    void primitive(const Json& primitive, const Pointer& where) {
        const Json& attributes = primitive["attributes"];
        const uint64_t count = parsed_.accessors[attributes.begin()->get<uint32_t>()].count;
        for (const auto& [name, accessor] : attributes.items()) {
            const Pointer at = where / "attributes" / name;
            attribute(name, accessor.get<uint32_t>(), false, at);
            demand(parsed_.accessors[accessor.get<uint32_t>()].count == count, at,
                   "has {} elements, but other attributes of the primitive have {}",
                   parsed_.accessors[accessor.get<uint32_t>()].count, count);
        }
        check_sets(attributes, where / "attributes");
        const Json& targets = list(primitive, "targets");
        for (size_t t = 0; t < targets.size(); ++t)
            for (const auto& [name, accessor] : targets[t].items()) {
                const Pointer at = where / "targets" / t / name;
                demand(attributes.contains(name), at,
                       "is a morph target of {}, which the primitive does not have", name);
                attribute(name, accessor.get<uint32_t>(), true, at);
                demand(parsed_.accessors[accessor.get<uint32_t>()].count == count, at,
                       "has {} elements, but the primitive has {} vertices",
                       parsed_.accessors[accessor.get<uint32_t>()].count, count);
            }
        if (primitive.contains("indices")) indices(*index_at(primitive, "indices"), where / "indices");
    }

    void attribute(std::string_view name, uint32_t index, bool is_delta, const Pointer& where) {
        const AttributeName parsed_name = parse_attribute_name(name);
        demand(parsed_name.semantic != Semantic::invalid, where,
               "is no attribute name; there are POSITION, NORMAL, TANGENT, TEXCOORD_n, COLOR_n, JOINTS_n, "
               "WEIGHTS_n "
               "and names that begin with _");
        const Accessor& accessor = parsed_.accessors[index];
        demand(is_delta && parsed_name.semantic == Semantic::custom
                   ? true
                   : is_valid_format(parsed_name.semantic, accessor, is_delta, quantization_),
               where, "is accessor {}: {} components of type {}{}, which this attribute may not have", index,
               accessor.components(), static_cast<int>(accessor.storage.type),
               accessor.storage.normalized ? ", normalized" : "");
        const Json& json = parsed_.json["accessors"][index];
        if (parsed_name.semantic == Semantic::position)
            demand(json.contains("min") && json.contains("max"), where,
                   "is accessor {}, which has no min and max; positions must have them", index);
        set_usage(parsed_, index, Usage::attribute, where);
        if (const auto view = index_at(json, "bufferView")) vertex_view(*view, index, accessor, where);
    }

    void vertex_view(uint32_t view, uint32_t index, const Accessor& accessor, const Pointer& where) {
        set_view_usage(parsed_, view, ViewUsage::vertices, where);
        const Json& json = parsed_.json["bufferViews"][view];
        const bool has_stride = json.contains("byteStride");
        const uint64_t offset = unsigned_at(parsed_.json["accessors"][index], "byteOffset");
        demand(offset % 4 == 0 && (has_stride || accessor.element_size() % 4 == 0), where,
               "is accessor {}, whose elements do not begin at multiples of 4 bytes", index);
        if (has_stride) return;
        demand(vertex_accessor_[view].value_or(index) == index, where,
               "shares buffer view {} with accessor {}: then the view must have a byteStride", view,
               vertex_accessor_[view].value_or(index));
        vertex_accessor_[view] = index;
    }

    // Sets are counted from 0 without gaps; as many joints as weights.
    static void check_sets(const Json& attributes, const Pointer& where) {
        std::array<std::array<uint32_t, 2>, 4> sets{};  // per semantic: how many, one past the largest
        for (const auto& [name, accessor] : attributes.items()) {
            const AttributeName parsed_name = parse_attribute_name(name);
            if (parsed_name.semantic < Semantic::texcoord || parsed_name.semantic > Semantic::weights)
                continue;
            auto& [count, end] =
                sets[static_cast<size_t>(parsed_name.semantic) - static_cast<size_t>(Semantic::texcoord)];
            ++count;
            end = std::max(end, parsed_name.set + 1);
        }
        constexpr const char* names[] = {"TEXCOORD", "COLOR", "JOINTS", "WEIGHTS"};
        for (size_t i = 0; i < sets.size(); ++i)
            demand(sets[i][0] == sets[i][1], where,
                   "has {} sets of {}, which must be numbered from 0 without gaps", sets[i][0], names[i]);
        demand(sets[2][0] == sets[3][0], where, "has {} JOINTS and {} WEIGHTS, which must be as many",
               sets[2][0], sets[3][0]);
    }

    void indices(uint32_t index, const Pointer& where) {
        const Accessor& accessor = parsed_.accessors[index];
        const ComponentType type = accessor.storage.type;
        demand(accessor.components() == 1 && !accessor.storage.normalized &&
                   (type == ComponentType::uint8 || type == ComponentType::uint16 ||
                    type == ComponentType::uint32),
               where, "is accessor {}, which must be SCALAR of unsigned 8, 16 or 32 bit integers", index);
        set_usage(parsed_, index, Usage::indices, where);
        const auto view = index_at(parsed_.json["accessors"][index], "bufferView");
        if (!view) return;
        demand(!parsed_.json["bufferViews"][*view].contains("byteStride"), where,
               "is accessor {}, whose buffer view has a byteStride; only vertex attributes may", index);
        set_view_usage(parsed_, *view, ViewUsage::indices, where);
    }

    Parsed& parsed_;
    const Watch& watch_;
    std::vector<std::optional<uint32_t>> vertex_accessor_;  // per view without byteStride
    bool quantization_;
};

}  // namespace

void set_usage(Parsed& parsed, uint32_t accessor, Usage usage, const Pointer& where) {
    Usage& current = parsed.usages[accessor];
    demand(current == Usage::none || current == usage, where,
           "is accessor {}, which is already used as something else (indices, attributes, inverse bind "
           "matrices, "
           "animation input and output do not mix)",
           accessor);
    current = usage;
}

void set_view_usage(Parsed& parsed, uint32_t view, ViewUsage usage, const Pointer& where) {
    constexpr const char* names[] = {"nothing",  "vertices",  "indices", "inverse bind matrices",
                                     "an image", "other data"};
    ViewUsage& current = parsed.view_usages[view];
    demand(current == ViewUsage::none || current == usage, where,
           "uses buffer view {} for {}, but its target or another use is for {}", view,
           names[static_cast<size_t>(usage)], names[static_cast<size_t>(current)]);
    current = usage;
}

void check_meshes(Parsed& parsed, const Watch& watch) {
    MeshCheck check(parsed, watch);
    for (size_t i = 0; i < list(parsed.json, "meshes").size(); ++i) check.mesh(i);
}

void check_instancing(Parsed& parsed, const Watch& watch) {
    const Json& nodes = list(parsed.json, "nodes");
    for (size_t i = 0; i < nodes.size(); ++i) {
        watch.check();
        const Json* instancing = extension(nodes[i], "EXT_mesh_gpu_instancing");
        if (instancing == nullptr) continue;
        const Pointer where = pointer("nodes", i, "extensions", "EXT_mesh_gpu_instancing");
        demand(nodes[i].contains("mesh"), where, "is there, but the node has no mesh");
        const Json& attributes = (*instancing)["attributes"];
        const uint64_t count = parsed.accessors[attributes.begin()->get<uint32_t>()].count;
        for (const auto& [name, index] : attributes.items()) {
            const Pointer at = where / "attributes" / name;
            const Accessor& accessor = parsed.accessors[index.get<uint32_t>()];
            set_usage(parsed, index.get<uint32_t>(), Usage::instancing, at);
            demand(accessor.count == count, at, "has {} elements, but other attributes have {}",
                   accessor.count, count);
            const Storage& storage = accessor.storage;
            const bool is_float = storage.type == ComponentType::float32;
            const bool is_signed_normalized = storage.normalized && (storage.type == ComponentType::int8 ||
                                                                     storage.type == ComponentType::int16);
            if (name == "TRANSLATION" || name == "SCALE")
                demand(is_float && accessor.columns == 1 && accessor.rows == 3, at,
                       "must be VEC3 of 32-bit floats");
            else if (name == "ROTATION")
                demand((is_float || is_signed_normalized) && accessor.columns == 1 && accessor.rows == 4, at,
                       "must be VEC4 of 32-bit floats or normalized signed integers");
            else
                demand(name.starts_with('_'), at, "must be TRANSLATION, ROTATION, SCALE or begin with _");
        }
    }
}

}  // namespace coppice::gltf
