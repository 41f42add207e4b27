#include "bench/openmesh/decimate.h"

#include <OpenMesh/Core/Mesh/TriMesh_ArrayKernelT.hh>
#include <OpenMesh/Tools/Decimater/DecimaterT.hh>
#include <OpenMesh/Tools/Decimater/ModQuadricT.hh>

namespace coppice::peer {
namespace {

struct Traits : OpenMesh::DefaultTraits {
    using Point = OpenMesh::Vec3d;
};

// Most of the decimater's time goes into this one function of OpenMesh's library, which Debian builds with
// assertions that compare names of types at each access to a status. So it is here again, with the same
// answers, without them.
class HalfEdges : public OpenMesh::TriMesh_ArrayKernelT<Traits> {
  public:
    // The edge, its ends and its triangles stay a surface: the ends share no neighbours but those opposite.
    bool is_collapse_ok(HalfedgeHandle from_to) {
        const HalfedgeHandle to_from = opposite_halfedge_handle(from_to);
        const VertexHandle from = to_vertex_handle(to_from), to = to_vertex_handle(from_to);
        if (status(edge_handle(from_to)).deleted() || status(from).deleted() || status(to).deleted())
            return false;
        const VertexHandle left = opposite(from_to), right = opposite(to_from);
        if (hangs_on_nothing(from_to) || hangs_on_nothing(to_from) || left == right) return false;
        for (VertexVertexIter v = vv_iter(from); v.is_valid(); ++v) status(*v).set_tagged(false);
        for (VertexVertexIter v = vv_iter(to); v.is_valid(); ++v) status(*v).set_tagged(true);
        for (VertexVertexIter v = vv_iter(from); v.is_valid(); ++v) {
            if (status(*v).tagged() && *v != left && *v != right) return false;
        }
        const bool is_at_border = is_boundary(from_to) || is_boundary(to_from);
        return is_at_border || !is_boundary(from) || !is_boundary(to);
    }

  private:
    // The triangle's third vertex; invalid at a border.
    VertexHandle opposite(HalfedgeHandle h) const {
        return is_boundary(h) ? VertexHandle() : to_vertex_handle(next_halfedge_handle(h));
    }
    // The triangle has borders on both of its other sides.
    bool hangs_on_nothing(HalfedgeHandle h) const {
        if (is_boundary(h)) return false;
        const HalfedgeHandle next = next_halfedge_handle(h), last = next_halfedge_handle(next);
        return is_boundary(opposite_halfedge_handle(next)) && is_boundary(opposite_halfedge_handle(last));
    }
};

}  // namespace

size_t decimate_with_openmesh(const Triangles& mesh, size_t triangles) {
    HalfEdges half_edges;
    for (size_t i = 0; i < mesh.positions.size(); i += 3)
        half_edges.add_vertex({mesh.positions[i], mesh.positions[i + 1], mesh.positions[i + 2]});
    for (size_t i = 0; i < mesh.corners.size(); i += 3) {
        const auto corner = [&](size_t k) { return half_edges.vertex_handle(mesh.corners[i + k]); };
        half_edges.add_face(corner(0), corner(1), corner(2));
    }
    half_edges.request_vertex_status();
    half_edges.request_edge_status();
    half_edges.request_face_status();
    half_edges.request_face_normals();
    half_edges.update_face_normals();
    OpenMesh::Decimater::DecimaterT<HalfEdges> decimater(half_edges);
    OpenMesh::Decimater::ModQuadricT<HalfEdges>::Handle quadric;
    decimater.add(quadric);
    decimater.module(quadric).unset_max_err();
    decimater.initialize();
    decimater.decimate_to_faces(0, triangles);
    half_edges.garbage_collection();
    return half_edges.n_faces();
}

}  // namespace coppice::peer
