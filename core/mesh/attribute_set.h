// Slots compared by the attributes that they have.
#pragma once

#include <vector>

#include "core/mesh/mesh.h"

namespace coppice {

// Per attribute of the mesh whether the slot has it: equal for slots that have the same ones, however they
// say so.
inline std::vector<bool> attribute_set(const Mesh& mesh, const MaterialSlot& slot) {
    if (slot.has_attribute.empty()) return std::vector<bool>(mesh.attributes.size(), true);
    return slot.has_attribute;
}

}  // namespace coppice
