// Keeps the box of a mesh: at least one vertex stays within a tolerance of each of its six sides.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "core/base/watched_loop.h"
#include "core/simplify/collapse_mesh.h"

namespace coppice {

// The box may lose 1 % of its diagonal; rounding in writers needs a little of that.
inline constexpr double bounds_tolerance_of_diagonal = 0.009;

class BoundsGuard {
  public:
    // tolerance in mesh units: how far each side of the box may come in.
    BoundsGuard(const CollapseMesh& mesh, double tolerance, const Watch& watch = {})
        : box_(mesh.box()), tolerance_(tolerance), sides_(mesh.vertex_count(), 0) {
        watched_loop(mesh.vertex_count(), watch, [&](size_t i) {
            const auto v = static_cast<uint32_t>(i);
            if (!mesh.is_live_vertex(v)) return;
            sides_[v] = sides_at(mesh.position(v));
            add(sides_[v]);
        });
    }

    bool may_remove(uint32_t vertex) const {
        for (uint32_t side = 0; side < 6; ++side) {
            if (holds(sides_[vertex], side) && left_[side] == 1) return false;
        }
        return true;
    }
    void remove(uint32_t vertex) {
        for (uint32_t side = 0; side < 6; ++side) left_[side] -= holds(sides_[vertex], side);
    }

    // Whether one vertex at that point may stand for all these.
    bool may_merge(std::span<const uint32_t> vertices, Vec3d point) const {
        uint32_t held = 0;
        for (const uint32_t v : vertices) held |= sides_[v];
        if (distance_outside(point) > tolerance_) return false;
        if (held == 0) return true;
        held &= ~uint32_t{sides_at(point)};
        for (uint32_t side = 0; side < 6; ++side) {
            if (!holds(held, side)) continue;
            uint32_t holders = 0;
            for (const uint32_t v : vertices) holders += holds(sides_[v], side);
            if (holders == left_[side]) return false;
        }
        return true;
    }
    void merge(std::span<const uint32_t> vertices, uint32_t kept, Vec3d point) {
        for (const uint32_t v : vertices) remove(v);
        sides_[kept] = sides_at(point);
        add(sides_[kept]);
    }

  private:
    static bool holds(uint32_t sides, uint32_t side) { return (sides >> side & 1U) != 0; }

    std::array<double, 6> distances(Vec3d p) const {
        return {p.x - box_.min.x, p.y - box_.min.y, p.z - box_.min.z,
                box_.max.x - p.x, box_.max.y - p.y, box_.max.z - p.z};
    }
    double distance_outside(Vec3d p) const {
        const std::array<double, 6> inside = distances(p);
        return -*std::min_element(inside.begin(), inside.end());
    }
    uint8_t sides_at(Vec3d p) const {
        const std::array<double, 6> inside = distances(p);
        uint32_t sides = 0;
        for (uint32_t side = 0; side < 6; ++side) sides |= uint32_t{inside[side] <= tolerance_} << side;
        return static_cast<uint8_t>(sides);
    }
    void add(uint8_t sides) {
        for (uint32_t side = 0; side < 6; ++side) left_[side] += holds(sides, side);
    }

    Bounds box_;
    double tolerance_;
    std::vector<uint8_t> sides_;         // per vertex, a bit per side that it holds
    std::array<uint32_t, 6> left_ = {};  // vertices that hold each side
};

}  // namespace coppice
