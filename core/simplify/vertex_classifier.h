// Classifies vertices one by one: what their surroundings are like now.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "core/base/watched_loop.h"
#include "core/simplify/collapse_mesh.h"
#include "core/simplify/neighbours.h"
#include "core/simplify/vertex_kind.h"

namespace coppice {

// Reused scratch. One object, one thread.
class VertexClassifier {
  public:
    VertexClassifier(const CollapseMesh& mesh, const Watch& watch)
        : mesh_(mesh), steps_(watch), neighbours_(mesh.vertex_count(), watch) {}

    VertexKind classify(uint32_t vertex);

    // Of the vertex that was classified last.

    // Edges of borders and seams; each is reported from its lower vertex.
    void append_features(uint32_t vertex, std::vector<FeatureEdge>& edges) const;
    // The same, of all at this vertex.
    void append_lines(uint32_t vertex, std::vector<FeatureEdge>& edges) const;
    // The other ends of those, each once.
    std::vector<uint32_t> line_neighbours() const;

  private:
    // The triangles at an edge that have the same third vertex: one, or several that lie on each other (a
    // decal of another material, two sheets back to back).
    struct Side {
        uint32_t opposite = no_index;
        uint32_t triangle = 0;  // the first
        uint32_t layers = 0;
        uint64_t charts = 0;  // at both ends of the edge, summed over the layers
    };

    // One edge from the vertex in question, as its triangles show it.
    struct Spoke {
        uint32_t neighbour = 0;
        std::array<Side, 2> sides = {};
        bool crowded = false;  // more than two sides
        uint32_t fan = 0;      // union-find parent, index of a spoke

        bool is_border() const { return !crowded && sides[1].layers == 0; }
        // Charts break, or a layer ends.
        bool is_seam() const {
            return !crowded && sides[1].layers > 0 &&
                   (sides[0].layers != sides[1].layers || sides[0].charts != sides[1].charts);
        }
    };

    void append_line(uint32_t vertex, const Spoke& spoke, std::vector<FeatureEdge>& edges) const;
    bool is_plain(uint32_t vertex) const;
    void gather_spokes(uint32_t vertex);
    uint32_t use(uint32_t near, uint32_t far);
    uint32_t root(uint32_t i);
    void unite(uint32_t a, uint32_t b);

    const CollapseMesh& mesh_;
    WatchedSteps steps_;
    Neighbours neighbours_;
    std::vector<Spoke> spokes_;
};

}  // namespace coppice
