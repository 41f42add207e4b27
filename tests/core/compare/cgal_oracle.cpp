#include "tests/core/compare/cgal_oracle.h"

// Sequential; CGAL 5.5 and 6.0 name the traits of a tree differently.
#include <CGAL/AABB_tree.h>
#if __has_include(<CGAL/AABB_traits_3.h>)
#include <CGAL/AABB_traits_3.h>
#include <CGAL/AABB_triangle_primitive_3.h>
#else
#include <CGAL/AABB_traits.h>
#include <CGAL/AABB_triangle_primitive.h>
#endif
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Polygon_mesh_processing/distance.h>
#include <CGAL/Polygon_mesh_processing/polygon_soup_to_polygon_mesh.h>
#include <CGAL/Polygon_mesh_processing/self_intersections.h>
#include <CGAL/Surface_mesh.h>

#include <array>
#include <cmath>
#include <iterator>
#include <utility>

namespace coppice::test {

namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Point = Kernel::Point_3;
using Triangles = std::vector<Kernel::Triangle_3>;
#if __has_include(<CGAL/AABB_traits_3.h>)
using Primitive = CGAL::AABB_triangle_primitive_3<Kernel, Triangles::iterator>;
using Tree = CGAL::AABB_tree<CGAL::AABB_traits_3<Kernel, Primitive>>;
#else
using Primitive = CGAL::AABB_triangle_primitive<Kernel, Triangles::iterator>;
using Tree = CGAL::AABB_tree<CGAL::AABB_traits<Kernel, Primitive>>;
#endif
using SurfaceMesh = CGAL::Surface_mesh<Point>;

Point point(Vec3d p) {
    return {p.x, p.y, p.z};
}

std::optional<SurfaceMesh> surface_mesh_of(const Mesh& mesh) {
    std::vector<Point> points;
    for (const Vec3f& position : mesh.positions) points.push_back(point(to_double(position)));
    std::vector<std::array<size_t, 3>> triangles;
    for (size_t t = 0; t < mesh.triangle_count(); ++t)
        triangles.push_back({mesh.corner_vertex(t, 0), mesh.corner_vertex(t, 1), mesh.corner_vertex(t, 2)});
    if (!CGAL::Polygon_mesh_processing::is_polygon_soup_a_polygon_mesh(triangles)) return {};
    SurfaceMesh out;
    CGAL::Polygon_mesh_processing::polygon_soup_to_polygon_mesh(points, triangles, out);
    return out;
}

}  // namespace

std::vector<double> cgal_distances(const Mesh& mesh, const std::vector<Vec3d>& points) {
    Triangles triangles;
    for (size_t t = 0; t < mesh.triangle_count(); ++t) {
        triangles.emplace_back(point(mesh.corner_position(t, 0)), point(mesh.corner_position(t, 1)),
                               point(mesh.corner_position(t, 2)));
    }
    Tree tree(triangles.begin(), triangles.end());
    tree.accelerate_distance_queries();
    std::vector<double> distances;
    distances.reserve(points.size());
    for (const Vec3d& p : points) distances.push_back(std::sqrt(tree.squared_distance(point(p))));
    return distances;
}

std::optional<double> cgal_one_sided_hausdorff(const Mesh& from, const Mesh& to, double error) {
    const auto a = surface_mesh_of(from), b = surface_mesh_of(to);
    if (!a || !b) return {};
    return CGAL::Polygon_mesh_processing::bounded_error_Hausdorff_distance<CGAL::Sequential_tag>(*a, *b,
                                                                                                 error);
}

std::optional<size_t> cgal_self_intersections(const Mesh& mesh) {
    const auto surface = surface_mesh_of(mesh);
    if (!surface) return {};
    std::vector<std::pair<SurfaceMesh::Face_index, SurfaceMesh::Face_index>> pairs;
    CGAL::Polygon_mesh_processing::self_intersections(*surface, std::back_inserter(pairs));
    return pairs.size();
}

}  // namespace coppice::test
