// Where a vertex moves to a place of its own: which attributes its wedges get there. GAPS (Erikson and
// Manocha 1999, as ITS describes it): the place is projected onto the surface around both ends of the edge,
// before they are merged, and attributes are interpolated there; each chart on its own triangles.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "core/simplify/collapse_mesh.h"
#include "core/simplify/wedge_values.h"

namespace coppice {

class Projection {
  public:
    explicit Projection(const CollapseMesh& mesh) : mesh_(mesh) {}

    // Projects `at` for every wedge of `kept`: onto the triangles of the wedges that become it. wedge_map as
    // WedgeMap gives it for the pair. Ties go to the first triangle.
    void project(uint32_t removed, uint32_t kept, const std::vector<uint32_t>& wedge_map, Vec3d at);

    // Of a wedge of `kept`: parts of itself and of wedges of other vertices, three at most. Empty where no
    // triangle has it.
    std::span<const WedgeShare> shares(uint32_t wedge) const {
        const Nearest& nearest = nearest_[wedge - first_];
        return nearest.found ? std::span<const WedgeShare>(nearest.shares) : std::span<const WedgeShare>();
    }

  private:
    struct Nearest {
        bool found = false;
        double squared_distance = 0;
        std::array<WedgeShare, 3> shares = {};
    };

    void look_at(uint32_t corner, uint32_t wedge, Vec3d at);

    const CollapseMesh& mesh_;
    uint32_t first_ = 0;            // wedge of `kept`
    std::vector<Nearest> nearest_;  // per wedge of `kept`
};

// Barycentric weights of the point of a triangle that is nearest to p: >= 0, their sum is 1.
std::array<double, 3> nearest_in_triangle(Vec3d p, Vec3d a, Vec3d b, Vec3d c);

}  // namespace coppice
