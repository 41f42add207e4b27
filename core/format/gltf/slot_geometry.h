// A mesh as glTF stores it: vertex buffers, and a primitive's indices into one of them for each material
// slot.
#pragma once

#include <cstdint>
#include <deque>
#include <span>
#include <vector>

#include "core/base/watch.h"
#include "core/mesh/mesh.h"

namespace coppice::gltf {

// 65535 restarts primitives, so it is no index.
inline constexpr size_t largest_short_count = 65535;

class SlotGeometries {
  public:
    struct Slot {
        const std::vector<uint32_t>* wedges = nullptr;  // of its vertex buffer, in the order of their use
        std::vector<uint32_t> indices;                  // into wedges, 3 per triangle; none for an empty slot
    };

    // All slots with the same attributes share one vertex buffer, if that saves more than it costs: any wedge
    // that two of them use is stored once then.
    SlotGeometries(const Mesh& mesh, const Watch& watch);
    SlotGeometries(const SlotGeometries&) = delete;
    SlotGeometries& operator=(const SlotGeometries&) = delete;

    const Slot& operator[](uint32_t slot) const { return slots_[slot]; }

  private:
    template <typename Visit>
    void each_wedge(uint32_t slot, const Visit& visit) const;
    bool pays_to_share(std::span<const uint32_t> slots);
    void fill_buffer(std::span<const uint32_t> slots);

    const Mesh& mesh_;
    const Watch& watch_;
    std::vector<Slot> slots_;
    std::vector<std::vector<uint32_t>> triangles_;  // of each slot
    std::deque<std::vector<uint32_t>> buffers_;     // the wedges of each
    // Of each wedge: who saw it last.
    struct Seen {
        uint32_t slot, kind;     // kind: the first of the slots that may share
        uint32_t buffer, index;  // its place there
    };
    std::vector<Seen> seen_;
};

}  // namespace coppice::gltf
