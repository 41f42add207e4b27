#include "core/mesh/mesh.h"

#include <algorithm>

#include "core/base/watched_loop.h"

namespace coppice {

const Attribute* Mesh::find_attribute(std::string_view attribute_name) const {
    const auto found = std::find_if(attributes.begin(), attributes.end(),
                                    [&](const Attribute& a) { return a.name == attribute_name; });
    return found == attributes.end() ? nullptr : &*found;
}

bool is_consistent(const Mesh& mesh) {
    const auto below = [](const std::vector<uint32_t>& indices, size_t end) {
        return std::all_of(indices.begin(), indices.end(), [end](uint32_t i) { return i < end; });
    };
    const auto fits = [&](const Attribute& a) {
        return a.values.size() == a.components * mesh.wedge_count();
    };
    const auto& targets = mesh.morph_targets;
    return mesh.triangles.size() == 3 * mesh.triangle_slot.size() &&
           below(mesh.triangles, mesh.wedge_count()) && below(mesh.wedge_vertex, mesh.vertex_count()) &&
           below(mesh.triangle_slot, mesh.slots.size()) &&
           std::all_of(mesh.attributes.begin(), mesh.attributes.end(), fits) &&
           std::all_of(
               targets.begin(), targets.end(),
               [&](const MorphTarget& t) { return std::all_of(t.deltas.begin(), t.deltas.end(), fits); }) &&
           std::all_of(mesh.slots.begin(), mesh.slots.end(), [&](const MaterialSlot& slot) {
               return slot.has_attribute.empty() || slot.has_attribute.size() == mesh.attributes.size();
           });
}

namespace {

Attribute copy_of(const Attribute& from, const Watch& watch) {
    return {from.name, from.components, from.storage, watched_copy(from.values, watch)};
}

}  // namespace

Mesh without_triangles(const Mesh& from, const Watch& watch) {
    Mesh mesh;
    mesh.name = from.name;
    mesh.source_mesh = from.source_mesh;
    mesh.positions = watched_copy(from.positions, watch);
    mesh.position_storage = from.position_storage;
    mesh.wedge_vertex = watched_copy(from.wedge_vertex, watch);
    for (const Attribute& attribute : from.attributes) mesh.attributes.push_back(copy_of(attribute, watch));
    for (const MorphTarget& target : from.morph_targets) {
        mesh.morph_targets.emplace_back();
        for (const Attribute& delta : target.deltas)
            mesh.morph_targets.back().deltas.push_back(copy_of(delta, watch));
    }
    mesh.slots = from.slots;
    return mesh;
}

Mesh without_geometry(const Mesh& from) {
    Mesh mesh;
    mesh.name = from.name;
    mesh.source_mesh = from.source_mesh;
    mesh.position_storage = from.position_storage;
    mesh.slots = from.slots;
    const auto described = [](const Attribute& a) { return Attribute{a.name, a.components, a.storage}; };
    for (const Attribute& a : from.attributes) mesh.attributes.push_back(described(a));
    for (const MorphTarget& target : from.morph_targets) {
        mesh.morph_targets.emplace_back();
        for (const Attribute& a : target.deltas) mesh.morph_targets.back().deltas.push_back(described(a));
    }
    return mesh;
}

}  // namespace coppice
