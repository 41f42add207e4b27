// The triangles around a vertex, in the order in which they lie there. Reused scratch.
#pragma once

#include <cstdint>
#include <vector>

#include "core/simplify/collapse_mesh.h"

namespace coppice {

class VertexFan {
  public:
    // False where they are not one cycle, or one path at a border.
    bool gather(const CollapseMesh& mesh, uint32_t vertex);

    bool is_closed() const { return closed_; }
    uint32_t triangle_count() const { return static_cast<uint32_t>(corners_.size()); }
    // The vertex' corner in each triangle; triangle i holds places i and i + 1 of the ring.
    uint32_t corner(uint32_t triangle) const { return corners_[triangle]; }
    // Of a cycle as many vertices as triangles; of a path one more, from border to border.
    const std::vector<uint32_t>& ring() const { return ring_; }

  private:
    bool closed_ = false;
    std::vector<uint32_t> corners_, ring_, ends_;  // ends: of the triangles, while they are put in order
};

}  // namespace coppice
