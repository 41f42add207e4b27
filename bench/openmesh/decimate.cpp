#include "bench/openmesh/decimate.h"

#include <OpenMesh/Core/Mesh/TriMesh_ArrayKernelT.hh>
#include <OpenMesh/Tools/Decimater/DecimaterT.hh>
#include <OpenMesh/Tools/Decimater/ModQuadricT.hh>

namespace coppice::peer {
namespace {

struct Traits : OpenMesh::DefaultTraits {
    using Point = OpenMesh::Vec3d;
};
using HalfEdges = OpenMesh::TriMesh_ArrayKernelT<Traits>;

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
