// Which triangles touch a vertex, which triangles share an edge. Compressed sparse rows.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "core/base/watch.h"
#include "core/mesh/mesh.h"

namespace coppice {

// Triangles around each vertex, ascending.
struct VertexTriangles {
    std::vector<uint32_t> offsets;    // vertex count + 1
    std::vector<uint32_t> triangles;  // 3 * triangle count

    std::span<const uint32_t> around(uint32_t vertex) const {
        return std::span(triangles).subspan(offsets[vertex], offsets[vertex + 1] - offsets[vertex]);
    }
};

VertexTriangles vertex_triangles(const Mesh& mesh);

// An undirected edge between vertices, a < b, with how often triangles use it in either direction.
struct Edge {
    uint32_t a = 0, b = 0;
    uint32_t forward = 0;   // uses as a -> b
    uint32_t backward = 0;  // uses as b -> a

    uint32_t uses() const { return forward + backward; }
    bool is_border() const { return uses() == 1; }
    bool is_manifold() const { return uses() <= 2; }
};

// Every edge once, sorted by (a, b). Throws when the watch is stopped.
std::vector<Edge> edges(const Mesh& mesh, const Watch& watch = {});

struct Topology {
    size_t border_edges = 0;
    size_t non_manifold_edges = 0;  // more than two triangles
    size_t inconsistent_edges = 0;  // two triangles that run along it in the same direction
};

Topology topology(const Mesh& mesh);

}  // namespace coppice
