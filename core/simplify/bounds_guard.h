// Keeps the box of a mesh: at least one vertex stays within a tolerance of each of its six sides.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "core/base/watched_loop.h"
#include "core/simplify/collapse_mesh.h"

namespace coppice {

class BoundsGuard {
  public:
    // tolerance in mesh units: how far each side of the box may come in.
    BoundsGuard(const CollapseMesh& mesh, double tolerance, const Watch& watch = {})
        : sides_(mesh.vertex_count(), 0) {
        const Bounds& box = mesh.box();
        watched_loop(mesh.vertex_count(), watch, [&](size_t i) {
            const auto v = static_cast<uint32_t>(i);
            if (!mesh.is_live_vertex(v)) return;
            const Vec3d p = mesh.position(v);
            const std::array<double, 6> distance = {p.x - box.min.x, p.y - box.min.y, p.z - box.min.z,
                                                    box.max.x - p.x, box.max.y - p.y, box.max.z - p.z};
            for (uint32_t side = 0; side < 6; ++side) {
                if (distance[side] > tolerance) continue;
                sides_[v] = static_cast<uint8_t>(sides_[v] | (1U << side));
                ++left_[side];
            }
        });
    }

    bool may_remove(uint32_t vertex) const {
        for (uint32_t side = 0; side < 6; ++side) {
            if ((sides_[vertex] >> side & 1U) != 0 && left_[side] == 1) return false;
        }
        return true;
    }

    void remove(uint32_t vertex) {
        for (uint32_t side = 0; side < 6; ++side) left_[side] -= sides_[vertex] >> side & 1U;
    }

  private:
    std::vector<uint8_t> sides_;         // per vertex, a bit per side that it holds
    std::array<uint32_t, 6> left_ = {};  // vertices that hold each side
};

}  // namespace coppice
