// Virtual pairs (Garland and Heckbert 1997): vertices without an edge between them that lie near each other,
// so that parts which are not connected can be joined.
//
// Only vertices of open borders are paired. Where neither has a border, two surfaces could touch in single
// vertices alone, as an edge of four triangles is refused: that saves no triangle and would hold both in
// place.
#pragma once

#include <cstdint>
#include <vector>

#include "core/base/watch.h"
#include "core/simplify/collapse_mesh.h"
#include "core/simplify/vertex_kind.h"

namespace coppice {

// A hash grid with a list of vertices in each cell. A query looks at 27 cells, at a bounded number of
// vertices in each, whatever the mesh; where very many are near each other, cells are smaller than the
// distance, so that the nearest are among those. One object, one thread.
class VertexPairs {
  public:
    // Of the ends of these edges that are borders; none until a distance is set.
    VertexPairs(const CollapseMesh& mesh, const std::vector<FeatureEdge>& edges, const Watch& watch);

    // How near vertices of a pair are to each other, mesh units; over 0. O(vertices of borders).
    void set_distance(double distance, const Watch& watch);
    double distance() const { return distance_; }

    bool empty() const { return members_.empty(); }
    bool contains(uint32_t vertex) const { return cells_[vertex] < gone; }
    bool has_contained(uint32_t vertex) const { return cells_[vertex] != never; }

    // Appends the vertices that are paired with this one, 8 at most, the nearest first. `out` holds those
    // that an edge leads to, which are none of them.
    void append(uint32_t vertex, std::vector<uint32_t>& out) const;

    // To be called with every vertex that goes or has no border any more, and that has been moved.
    void erase(uint32_t vertex);
    void move(uint32_t vertex);

  private:
    static constexpr uint64_t never = UINT64_MAX, gone = never - 1;  // in place of a cell

    void fill(const Watch& watch);
    void insert(uint32_t vertex);
    uint64_t cell_at(Vec3d position) const;
    size_t bucket_of(uint64_t cell) const;

    const CollapseMesh& mesh_;
    double distance_ = 0, edge_ = 0;        // of a cell
    size_t filled_ = 0;                     // buckets that are not empty, once all were inserted
    std::vector<uint32_t> members_;         // ascending; those that have gone too
    std::vector<uint32_t> heads_;           // per bucket: its first vertex
    std::vector<uint64_t> cells_;           // per vertex
    std::vector<uint32_t> after_, before_;  // per vertex: the list of its bucket
};

}  // namespace coppice
