// The triangles around the two ends of an edge, and whether they stay sound when the ends become one.
#pragma once

#include <array>
#include <cstdint>

#include "core/simplify/attribute_quadric/lanes.h"

namespace coppice {

// The triangles at a vertex, in the order of the mesh: their other two corners, and where the mesh has them.
struct PackedRing {
    static constexpr uint32_t most = 64;
    std::array<uint32_t, most> next = {}, previous = {}, spoke = {};
    uint32_t count = 0;
    std::array<uint32_t, 2 * most> neighbours = {};  // each once
    uint32_t neighbour_count = 0;
};

// The ends have no neighbours in common but the corners opposite to their edge, of one or two triangles (Dey
// and others 1999), and no two triangles come to lie on each other.
bool has_sound_link(const PackedRing& removed, const PackedRing& kept, uint32_t kept_vertex);

// Those of them that stay, in fours, seen from where the vertex that stays is before the collapse. What is
// left over in the last four has no area.
struct PackedFan {
    struct Four {
        Vec3<Lanes> ahead, behind;  // the other two corners
        Vec3<Lanes> facing;         // where the surface faced there at the start, summed over both
    };

    void begin(Vec3f at) { tip = at, count = 0; }
    // The triangle at that place of the ring.
    void add(const PackedRing& ring, uint32_t place, const std::array<Vec3f, 2>& corners, Vec3f facing);
    bool holds(uint32_t vertex) const;  // beside the tip
    uint32_t four_count() const { return (count + lane_count - 1) / lane_count; }
    // The sum of ahead x behind: its product with the tip is six times the volume below the triangles.
    Vec3f outer() const;
    // From a point to the nearest triangle, with the tip elsewhere.
    double distance(Vec3d from, Vec3d moved_tip) const;

    Vec3f tip;  // the vertex that they share
    std::array<Four, PackedRing::most / lane_count> fours;
    std::array<uint32_t, PackedRing::most> next, previous, spoke;
    uint32_t count = 0;
};

// Whether the tip may be elsewhere: no triangle turns by more than about 75 degrees, now or away from where
// the surface faced at its corners at the start; none becomes degenerate. facing: at the tip, before and
// after.
bool keeps_orientation(const PackedFan& fan, Vec3f facing_before, Vec3f facing, Vec3f at);

}  // namespace coppice
