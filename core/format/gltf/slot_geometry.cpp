#include "core/format/gltf/slot_geometry.h"

#include <map>

#include "core/base/watched_loop.h"
#include "core/mesh/attribute_set.h"

namespace coppice::gltf {

namespace {

constexpr uint32_t none = UINT32_MAX;

// In the order of the first slot of each kind.
std::vector<std::vector<uint32_t>> slots_with_the_same_attributes(const Mesh& mesh) {
    std::map<std::vector<bool>, size_t> kinds;
    std::vector<std::vector<uint32_t>> slots;
    for (uint32_t slot = 0; slot < mesh.slots.size(); ++slot) {
        const auto [kind, is_new] = kinds.try_emplace(attribute_set(mesh, mesh.slots[slot]), slots.size());
        if (is_new) slots.emplace_back();
        slots[kind->second].push_back(slot);
    }
    return slots;
}

}  // namespace

SlotGeometries::SlotGeometries(const Mesh& mesh, const Watch& watch)
    : mesh_(mesh),
      watch_(watch),
      slots_(mesh.slots.size()),
      triangles_(mesh.slots.size()),
      seen_(watched_vector(mesh.wedge_count(), watch, Seen{none, none, none, none})) {
    watched_loop(mesh.triangle_count(), watch,
                 [&](size_t t) { triangles_[mesh.triangle_slot[t]].push_back(static_cast<uint32_t>(t)); });
    for (const std::vector<uint32_t>& slots : slots_with_the_same_attributes(mesh)) {
        if (pays_to_share(slots)) {
            fill_buffer(slots);
        } else {
            for (const uint32_t slot : slots) fill_buffer({&slot, 1});
        }
    }
}

template <typename Visit>
void SlotGeometries::each_wedge(uint32_t slot, const Visit& visit) const {
    const std::vector<uint32_t>& triangles = triangles_[slot];
    watched_loop(triangles.size(), watch_, [&](size_t i) {
        for (size_t corner = 0; corner < 3; ++corner)
            visit(mesh_.triangles[3 * size_t{triangles[i]} + corner]);
    });
}

// Not where longer indices would take more bytes than shared vertices save.
bool SlotGeometries::pays_to_share(std::span<const uint32_t> slots) {
    size_t apart = 0, together = 0, indices = 0;
    for (const uint32_t slot : slots) {
        each_wedge(slot, [&](uint32_t wedge) {
            Seen& seen = seen_[wedge];
            together += seen.kind != slots.front() ? 1 : 0;
            apart += seen.slot != slot ? 1 : 0;
            seen.kind = slots.front();
            seen.slot = slot;
            ++indices;
        });
    }
    const size_t saved = (apart - together) * sizeof(Vec3f);  // at least: each has a position
    const size_t longer = together > largest_short_count ? indices * sizeof(uint16_t) : 0;
    return saved > longer;
}

void SlotGeometries::fill_buffer(std::span<const uint32_t> slots) {
    const auto buffer = static_cast<uint32_t>(buffers_.size());
    std::vector<uint32_t>& wedges = buffers_.emplace_back();
    for (const uint32_t slot : slots) {
        slots_[slot].wedges = &wedges;
        each_wedge(slot, [&](uint32_t wedge) {
            Seen& seen = seen_[wedge];
            if (seen.buffer != buffer) {
                seen.buffer = buffer;
                seen.index = static_cast<uint32_t>(wedges.size());
                wedges.push_back(wedge);
            }
            slots_[slot].indices.push_back(seen.index);
        });
    }
}

}  // namespace coppice::gltf
