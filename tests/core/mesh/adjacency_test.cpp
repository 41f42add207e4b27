#include "core/mesh/adjacency.h"

#include <gmock/gmock.h>

namespace coppice {
namespace {

using testing::ElementsAre;

// `triangles` over vertices that are also the wedges; where they lie does not matter here.
Mesh mesh_of(std::vector<uint32_t> triangles, uint32_t vertices) {
    Mesh mesh;
    mesh.positions.resize(vertices);
    for (uint32_t v = 0; v < vertices; ++v) mesh.wedge_vertex.push_back(v);
    mesh.triangle_slot.assign(triangles.size() / 3, 0);
    mesh.triangles = std::move(triangles);
    mesh.slots.resize(1);
    return mesh;
}

TEST(VertexTriangles, lists_the_triangles_around_each_vertex) {
    const VertexTriangles rows = vertex_triangles(mesh_of({0, 1, 2, 0, 2, 3}, 5));
    EXPECT_THAT(rows.around(0), ElementsAre(0, 1));
    EXPECT_THAT(rows.around(1), ElementsAre(0));
    EXPECT_THAT(rows.around(4), ElementsAre());
}

TEST(Edges, lists_each_edge_once_with_its_uses) {
    const std::vector<Edge> all = edges(mesh_of({0, 1, 2, 0, 2, 3}, 4));
    ASSERT_EQ(all.size(), 5);
    EXPECT_EQ(all[1].a, 0);
    EXPECT_EQ(all[1].b, 2);
    EXPECT_EQ(all[1].forward, 1);
    EXPECT_EQ(all[1].backward, 1);
    EXPECT_TRUE(all[0].is_border());
}

TEST(Topology, of_a_tetrahedron_is_closed_and_manifold) {
    const Topology t = topology(mesh_of({0, 1, 2, 0, 2, 3, 0, 3, 1, 1, 3, 2}, 4));
    EXPECT_EQ(t.border_edges, 0);
    EXPECT_EQ(t.non_manifold_edges, 0);
    EXPECT_EQ(t.inconsistent_edges, 0);
}

TEST(Topology, finds_a_fin_and_a_turned_triangle) {
    EXPECT_EQ(topology(mesh_of({0, 1, 2, 1, 0, 3, 0, 1, 4}, 5)).non_manifold_edges, 1);
    EXPECT_EQ(topology(mesh_of({0, 1, 2, 0, 1, 3}, 4)).inconsistent_edges, 1);
}

}  // namespace
}  // namespace coppice
