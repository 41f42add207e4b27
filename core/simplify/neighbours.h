// The vertices around a vertex, with how often its triangles use the edge to each. Reused scratch: no
// allocation once it has grown.
#pragma once

#include <cstdint>
#include <vector>

#include "core/simplify/collapse_mesh.h"

namespace coppice {

class Neighbours {
  public:
    explicit Neighbours(uint32_t vertex_count) : stamp_(vertex_count, 0), place_(vertex_count, 0) {}

    // Forgets the last vertex and gathers the neighbours of this one, in the order of its corners.
    void gather(const CollapseMesh& mesh, uint32_t vertex) {
        begin();
        for (uint32_t c = mesh.first_corner(vertex); c != no_index; c = mesh.corner_after(c)) {
            add(mesh.corner_vertex(CollapseMesh::next_corner(c)));
            add(mesh.corner_vertex(CollapseMesh::previous_corner(c)));
        }
    }

    const std::vector<uint32_t>& all() const { return list_; }
    bool contains(uint32_t vertex) const { return stamp_[vertex] == now_; }
    // Triangles at the edge to this vertex; 0 when there is none.
    uint32_t uses(uint32_t vertex) const { return contains(vertex) ? uses_[place_[vertex]] : 0; }
    // Position in all(). The vertex must be contained.
    uint32_t place(uint32_t vertex) const { return place_[vertex]; }

  private:
    void begin() {
        list_.clear();
        uses_.clear();
        if (++now_ == 0) {  // after 2^32 rounds
            stamp_.assign(stamp_.size(), 0);
            now_ = 1;
        }
    }
    void add(uint32_t vertex) {
        if (stamp_[vertex] == now_) {
            ++uses_[place_[vertex]];
            return;
        }
        stamp_[vertex] = now_;
        place_[vertex] = static_cast<uint32_t>(list_.size());
        list_.push_back(vertex);
        uses_.push_back(1);
    }

    std::vector<uint32_t> stamp_, place_;  // per vertex of the mesh
    std::vector<uint32_t> list_, uses_;
    uint32_t now_ = 0;
};

}  // namespace coppice
