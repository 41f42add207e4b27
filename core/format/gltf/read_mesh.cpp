#include "core/format/gltf/read_mesh.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <map>

#include "core/base/watched_loop.h"
#include "core/format/clean_triangles.h"
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

using Layouts = std::map<std::string_view, Layout>;  // by the attribute's name

void join(Layouts& layouts, const NamedAccessors& accessors) {
    for (const auto& [name, accessor] : accessors) {
        Layout& layout = layouts[name];
        layout = joined(layout, *accessor, parse_attribute_name(name).semantic);
    }
}

std::vector<Attribute> attributes_of(const Layouts& layouts) {
    std::vector<Attribute> out;
    for (const auto& [name, layout] : layouts)
        out.push_back({std::string(name), layout.components, layout.storage});
    return out;
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
        make_room();
        for (size_t s = 0; s < data_.size(); ++s) {
            watch_.check();
            fill(s);
        }
        clean();
        return std::move(mesh_);
    }

  private:
    void add_slot(const Json& primitive, uint32_t p) {
        const Pointer where = pointer("meshes", index_, "primitives", p);
        data_.push_back(read_primitive(
            parsed_, primitive,
            {limits_.triangles - budget_.triangles, limits_.attribute_bytes - budget_.attribute_bytes}, where,
            watch_));
        budget_.triangles += data_.back().triangles.size() / 3;
        require(budget_.triangles <= limits_.triangles, ErrorCode::asset_too_large, where,
                "the meshes have more than {} triangles (limit triangles)", limits_.triangles);
        used_.push_back(take_used(data_.back()));
        budget_.vertices += used_.back().size();
        require(budget_.vertices <= limits_.vertices, ErrorCode::asset_too_large, where,
                "the meshes have more than {} vertices (limit vertices)", limits_.vertices);
        MaterialSlot slot;
        slot.material = index_at(primitive, "material");
        slot.source_primitive = p;
        mesh_.slots.push_back(slot);
    }

    // The vertices that triangles use, ascending, and the triangles in terms of them.
    std::vector<uint32_t> take_used(PrimitiveData& data) const {
        std::vector<uint32_t> used = watched_copy(data.triangles, watch_);
        WatchedSteps steps(watch_);
        std::sort(used.begin(), used.end(), steps.counting(std::less<>()));
        used.erase(std::unique(used.begin(), used.end()), used.end());
        used.shrink_to_fit();
        watched_loop(data.triangles.size(), watch_, [&](size_t i) {
            uint32_t& corner = data.triangles[i];
            corner = static_cast<uint32_t>(std::lower_bound(used.begin(), used.end(), corner) - used.begin());
        });
        return used;
    }

    // The attributes and morph deltas of all slots together.
    void lay_out() {
        Layouts attributes;
        std::vector<Layouts> targets;
        Layout positions;
        for (const PrimitiveData& data : data_) {
            positions = joined(positions, *data.positions, Semantic::position);
            join(attributes, data.attributes);
            targets.resize(std::max(targets.size(), data.targets.size()));
            for (size_t t = 0; t < data.targets.size(); ++t) join(targets[t], data.targets[t]);
        }
        mesh_.position_storage = positions.storage;
        mesh_.attributes = attributes_of(attributes);
        for (const Layouts& deltas : targets) mesh_.morph_targets.push_back({attributes_of(deltas)});
        for (MaterialSlot& slot : mesh_.slots) slot.has_attribute.resize(mesh_.attributes.size());
    }

    // All vertices get all attributes, which is little for each and may be much for all.
    void make_room() {
        uint64_t wedges = 0;
        for (const std::vector<uint32_t>& used : used_) wedges += used.size();
        uint64_t components = 0;
        const auto for_each_stream = [&](const auto& visit) {
            for (Attribute& attribute : mesh_.attributes) visit(attribute);
            for (MorphTarget& target : mesh_.morph_targets)
                for (Attribute& delta : target.deltas) visit(delta);
        };
        for_each_stream([&](const Attribute& stream) { components += stream.components; });
        budget_.attribute_bytes += wedges * components * sizeof(float);
        require(budget_.attribute_bytes <= limits_.attribute_bytes, ErrorCode::asset_too_large,
                pointer("meshes", index_),
                "the meshes' attributes take more than {} bytes (limit attribute_bytes)",
                limits_.attribute_bytes);
        mesh_.positions.reserve(wedges);
        mesh_.wedge_vertex.reserve(wedges);
        for_each_stream(
            [&](Attribute& stream) { watched_resize(stream.values, wedges * stream.components, watch_); });
    }

    void fill(size_t slot) {
        PrimitiveData& data = data_[slot];
        const std::vector<uint32_t>& used = used_[slot];
        const auto first = static_cast<uint32_t>(mesh_.wedge_vertex.size());
        watched_loop(used.size(), watch_, [&](size_t i) {
            const uint32_t vertex = used[i];
            const Accessor& at = *data.positions;
            const Vec3f p = {at.value(vertex, 0), at.value(vertex, 1), at.value(vertex, 2)};
            demand(std::isfinite(p.x) && std::isfinite(p.y) && std::isfinite(p.z), pointer("meshes", index_),
                   "has a position that is infinite or not a number, at vertex {} of primitive {}", vertex,
                   *mesh_.slots[slot].source_primitive);
            mesh_.wedge_vertex.push_back(static_cast<uint32_t>(mesh_.positions.size()));
            mesh_.positions.push_back(p);
        });
        mesh_.triangles.reserve(mesh_.triangles.size() + data.triangles.size());
        watched_loop(data.triangles.size(), watch_,
                     [&](size_t i) { mesh_.triangles.push_back(first + data.triangles[i]); });
        mesh_.triangle_slot.insert(mesh_.triangle_slot.end(), data.triangles.size() / 3,
                                   static_cast<uint32_t>(slot));
        for (const NamedAccessor& from : data.attributes) {
            const size_t a = find(mesh_.attributes, from.name);
            mesh_.slots[slot].has_attribute[a] = true;
            set_values(mesh_.attributes[a], *from.accessor, used, first);
        }
        for (size_t t = 0; t < data.targets.size(); ++t) {
            std::vector<Attribute>& deltas = mesh_.morph_targets[t].deltas;
            for (const NamedAccessor& from : data.targets[t])
                set_values(deltas[find(deltas, from.name)], *from.accessor, used, first);
        }
        data = {};
    }

    // sorted: by name, as attributes_of made them.
    static size_t find(const std::vector<Attribute>& sorted, std::string_view name) {
        const auto found =
            std::lower_bound(sorted.begin(), sorted.end(), name,
                             [](const Attribute& a, std::string_view wanted) { return a.name < wanted; });
        return static_cast<size_t>(found - sorted.begin());
    }

    // first: the wedge of the first of the used vertices.
    void set_values(Attribute& attribute, const Accessor& from, const std::vector<uint32_t>& used,
                    size_t first) const {
        const bool is_color = parse_attribute_name(attribute.name).semantic == Semantic::color;
        float* value = attribute.values.data() + first * attribute.components;
        watched_loop(used.size(), watch_, [&](size_t i) {
            for (uint32_t c = 0; c < attribute.components; ++c, ++value) {
                // A colour without alpha, beside others that have it, is opaque.
                *value = c < from.components() ? from.value(used[i], c) : is_color ? 1.0F : 0.0F;
                if (!std::isfinite(*value)) *value = 0;
            }
        });
    }

    void clean() {
        make_legal(mesh_, watch_);
        weld(mesh_, watch_);
        clean_triangles(mesh_, fmt::format("mesh {}", index_), pointer("meshes", index_).text(),
                        parsed_.warnings, watch_);
    }

    Parsed& parsed_;
    uint32_t index_;
    const ReadLimits& limits_;
    MeshBudget& budget_;
    const Watch& watch_;
    Mesh mesh_;
    std::vector<PrimitiveData> data_;          // per slot
    std::vector<std::vector<uint32_t>> used_;  // per slot: the vertices that triangles use, ascending
};

}  // namespace

Mesh read_mesh(Parsed& parsed, uint32_t index, const ReadLimits& limits, MeshBudget& budget,
               const Watch& watch) {
    return MeshReader(parsed, index, limits, budget, watch).read();
}

}  // namespace coppice::gltf
