#include "core/mesh/mesh.h"

#include <algorithm>

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

}  // namespace coppice
