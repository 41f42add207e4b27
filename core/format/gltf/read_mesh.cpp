#include "core/format/gltf/read_mesh.h"

#include <algorithm>
#include <cmath>

#include "core/format/gltf/legal_values.h"
#include "core/format/gltf/read_primitive.h"
#include "core/format/gltf/semantics.h"
#include "core/mesh/weld.h"

namespace coppice::gltf {

namespace {

// What the primitives of a mesh store an attribute as, made one: the same when all agree, else what holds
// them all.
struct Layout {
    uint32_t components = 0;
    Storage storage = {};
};

Layout joined(const Layout& a, const Accessor& b, Semantic semantic) {
    if (a.components == 0) return {b.components(), b.storage};
    Layout both{std::max(a.components, b.components()), a.storage};
    if (a.storage == b.storage) return both;
    both.storage = semantic == Semantic::joints ? Storage{ComponentType::uint16, false} : Storage{};
    return both;
}

class MeshReader {
  public:
    MeshReader(Parsed& parsed, uint32_t index, const ReadLimits& limits, MeshBudget& budget,
               const Watch& watch)
        : parsed_(parsed), index_(index), limits_(limits), budget_(budget), watch_(watch) {}

    Mesh read() {
        const Json& json = parsed_.json["meshes"][index_];
        mesh_.name = text_at(json, "name");
        mesh_.source_mesh = index_;
        const Json& primitives = json["primitives"];
        for (uint32_t p = 0; p < primitives.size(); ++p) {
            watch_.check();
            if (is_triangles(primitives[p])) add_slot(primitives[p], p);
        }
        lay_out();
        for (size_t s = 0; s < data_.size(); ++s) {
            watch_.check();
            fill(s);
        }
        clean();
        return std::move(mesh_);
    }

  private:
    void add_slot(const Json& primitive, uint32_t p) {
        const std::string where = pointer("meshes", index_, "primitives", p);
        data_.push_back(read_primitive(parsed_, primitive, limits_.triangles - budget_.triangles, where));
        budget_.triangles += data_.back().triangles.size() / 3;
        require(budget_.triangles <= limits_.triangles, ErrorCode::asset_too_large, where,
                "the meshes have more than {} triangles (limit triangles)", limits_.triangles);
        MaterialSlot slot;
        slot.material = index_at(primitive, "material");
        slot.source_primitive = p;
        mesh_.slots.push_back(slot);
    }

    // The attributes and morph deltas of all slots together.
    void lay_out() {
        std::map<std::string, Layout> attributes;
        size_t targets = 0;
        for (const PrimitiveData& data : data_) {
            targets = std::max(targets, data.targets.size());
            for (const auto& [name, accessor] : data.attributes)
                attributes[name] = joined(attributes[name], accessor, parse_attribute_name(name).semantic);
        }
        for (const auto& [name, layout] : attributes) {
            if (name == "POSITION")
                mesh_.position_storage = layout.storage;
            else
                mesh_.attributes.push_back({name, layout.components, layout.storage});
        }
        mesh_.morph_targets.resize(targets);
        for (size_t t = 0; t < targets; ++t) {
            std::map<std::string, Layout> deltas;
            for (const PrimitiveData& data : data_)
                for (const auto& [name, accessor] : data.targets[t])
                    deltas[name] = joined(deltas[name], accessor, parse_attribute_name(name).semantic);
            for (const auto& [name, layout] : deltas)
                mesh_.morph_targets[t].deltas.push_back({name, layout.components, layout.storage});
        }
        for (size_t s = 0; s < data_.size(); ++s)
            for (const Attribute& attribute : mesh_.attributes)
                mesh_.slots[s].has_attribute.push_back(data_[s].attributes.contains(attribute.name));
    }

    // The vertices that triangles use, ascending, and the triangles in terms of them.
    std::vector<uint32_t> take_used(PrimitiveData& data) const {
        std::vector<uint32_t> used = data.triangles;
        std::sort(used.begin(), used.end());
        used.erase(std::unique(used.begin(), used.end()), used.end());
        for (uint32_t& corner : data.triangles)
            corner = static_cast<uint32_t>(std::lower_bound(used.begin(), used.end(), corner) - used.begin());
        return used;
    }

    void fill(size_t slot) {
        PrimitiveData& data = data_[slot];
        const std::vector<uint32_t> used = take_used(data);
        budget_.vertices += used.size();
        require(budget_.vertices <= limits_.vertices, ErrorCode::asset_too_large, pointer("meshes", index_),
                "the meshes have more than {} vertices (limit vertices)", limits_.vertices);
        const auto first = static_cast<uint32_t>(mesh_.wedge_vertex.size());
        const Accessor& position = data.attributes.at("POSITION");
        for (const uint32_t vertex : used) {
            const Vec3f p = {position.value(vertex, 0), position.value(vertex, 1), position.value(vertex, 2)};
            demand(std::isfinite(p.x) && std::isfinite(p.y) && std::isfinite(p.z), pointer("meshes", index_),
                   "has a position that is infinite or not a number, at vertex {} of primitive {}", vertex,
                   *mesh_.slots[slot].source_primitive);
            mesh_.wedge_vertex.push_back(static_cast<uint32_t>(mesh_.positions.size()));
            mesh_.positions.push_back(p);
        }
        for (const uint32_t corner : data.triangles) mesh_.triangles.push_back(first + corner);
        mesh_.triangle_slot.insert(mesh_.triangle_slot.end(), data.triangles.size() / 3,
                                   static_cast<uint32_t>(slot));
        for (Attribute& attribute : mesh_.attributes) append_values(attribute, data.attributes, used);
        for (size_t t = 0; t < mesh_.morph_targets.size(); ++t)
            for (Attribute& delta : mesh_.morph_targets[t].deltas)
                append_values(delta, data.targets[t], used);
        data = {};
    }

    static void append_values(Attribute& attribute, const std::map<std::string, Accessor>& from,
                              const std::vector<uint32_t>& used) {
        const auto found = from.find(attribute.name);
        if (found == from.end()) {
            attribute.values.resize(attribute.values.size() + used.size() * attribute.components, 0.0F);
            return;
        }
        const Accessor& accessor = found->second;
        const bool is_color = parse_attribute_name(attribute.name).semantic == Semantic::color;
        for (const uint32_t vertex : used)
            for (uint32_t c = 0; c < attribute.components; ++c) {
                // A colour without alpha, beside others that have it, is opaque.
                const float value = c < accessor.components() ? accessor.value(vertex, c)
                                    : is_color                ? 1.0F
                                                              : 0.0F;
                attribute.values.push_back(std::isfinite(value) ? value : 0.0F);
            }
    }

    void clean() {
        make_legal(mesh_);
        weld(mesh_, watch_);
        const CleanedTriangles cleaned = drop_degenerate_and_duplicate(mesh_, watch_);
        drop_unused(mesh_, watch_);
        const std::string where = pointer("meshes", index_);
        if (cleaned.degenerate > 0)
            parsed_.warn(
                "repair.degenerate_triangles",
                fmt::format("{} degenerate triangles of mesh {} were dropped", cleaned.degenerate, index_),
                where);
        if (cleaned.duplicate > 0)
            parsed_.warn(
                "repair.duplicate_triangles",
                fmt::format("{} duplicate triangles of mesh {} were dropped", cleaned.duplicate, index_),
                where);
    }

    Parsed& parsed_;
    uint32_t index_;
    const ReadLimits& limits_;
    MeshBudget& budget_;
    const Watch& watch_;
    Mesh mesh_;
    std::vector<PrimitiveData> data_;  // per slot
};

}  // namespace

Mesh read_mesh(Parsed& parsed, uint32_t index, const ReadLimits& limits, MeshBudget& budget,
               const Watch& watch) {
    return MeshReader(parsed, index, limits, budget, watch).read();
}

}  // namespace coppice::gltf
