#include "core/mesh/adjacency.h"

#include "core/base/watched_loop.h"
#include "core/base/watched_sort.h"

namespace coppice {

VertexTriangles vertex_triangles(const Mesh& mesh) {
    VertexTriangles rows;
    rows.offsets.assign(mesh.vertex_count() + 1, 0);
    for (const uint32_t wedge : mesh.triangles) ++rows.offsets[mesh.wedge_vertex[wedge] + 1];
    for (size_t v = 0; v < mesh.vertex_count(); ++v) rows.offsets[v + 1] += rows.offsets[v];
    std::vector<uint32_t> next(rows.offsets.begin(), rows.offsets.end() - 1);
    rows.triangles.resize(mesh.triangles.size());
    for (size_t corner = 0; corner < mesh.triangles.size(); ++corner) {
        const uint32_t vertex = mesh.wedge_vertex[mesh.triangles[corner]];
        rows.triangles[next[vertex]++] = static_cast<uint32_t>(corner / 3);
    }
    return rows;
}

std::vector<Edge> edges(const Mesh& mesh, const Watch& watch) {
    std::vector<Edge> uses;
    uses.reserve(mesh.triangles.size());
    watched_loop(mesh.triangle_count(), watch, [&](size_t t) {
        for (size_t corner = 0; corner < 3; ++corner) {
            const uint32_t from = mesh.corner_vertex(t, corner);
            const uint32_t to = mesh.corner_vertex(t, (corner + 1) % 3);
            if (from < to) uses.push_back({from, to, 1, 0});
            if (from > to) uses.push_back({to, from, 0, 1});
        }
    });
    watched_sort(uses.begin(), uses.end(), watch,
                 [](const Edge& x, const Edge& y) { return x.a != y.a ? x.a < y.a : x.b < y.b; });
    size_t kept = 0;
    watched_loop(uses.size(), watch, [&](size_t i) {
        const Edge use = uses[i];
        if (kept > 0 && uses[kept - 1].a == use.a && uses[kept - 1].b == use.b) {
            uses[kept - 1].forward += use.forward;
            uses[kept - 1].backward += use.backward;
        } else {
            uses[kept++] = use;
        }
    });
    uses.resize(kept);
    return uses;
}

Topology topology(const Mesh& mesh) {
    Topology result;
    for (const Edge& edge : edges(mesh)) {
        result.border_edges += edge.is_border() ? 1 : 0;
        result.non_manifold_edges += edge.is_manifold() ? 0 : 1;
        result.inconsistent_edges += edge.uses() == 2 && edge.forward != edge.backward ? 1 : 0;
    }
    return result;
}

}  // namespace coppice
