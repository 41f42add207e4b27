// Vertices merged without any guard, as the clustering algorithms print it: for reproduction.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "core/base/watch.h"
#include "core/mesh/mesh.h"

namespace coppice {

// Union-find over the vertices of a mesh, each cluster at a point. Needs no adjacency, so takes any mesh.
// Copies are cheap enough to try a threshold on.
class VertexClusters {
  public:
    explicit VertexClusters(const Mesh& mesh);

    uint32_t root(uint32_t vertex);
    Vec3d position(uint32_t root) const { return positions_[root]; }
    // Merges clusters, named by their roots, at a point.
    void merge(std::span<const uint32_t> roots, Vec3d point);

    // Per root: merged since begin_round().
    bool is_merged(uint32_t root) const { return merged_[root]; }
    void begin_round() { merged_.assign(merged_.size(), false); }

    // Triangles whose corners are in three clusters; duplicates among them are counted. vertices: clusters of
    // these.
    struct Count {
        uint64_t triangles = 0, vertices = 0;
    };
    Count count(const Mesh& mesh);

    // The mesh with a vertex per cluster: degenerate triangles dropped, of those on the same three vertices,
    // in either winding, the first kept. Attributes of a cluster are the means of its members', apart on both
    // sides of seams and hard edges as far as triangles connect them.
    Mesh extract(const Mesh& source, const Watch& watch);

    // The farthest that a vertex went.
    double largest_move(const Mesh& mesh);

  private:
    std::vector<uint32_t> parents_;  // lower ones are roots
    std::vector<Vec3d> positions_;   // of roots
    std::vector<bool> merged_;
};

}  // namespace coppice
