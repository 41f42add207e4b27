// CGAL's answers to what core/compare asks, in a translation unit of its own: it shares no code with ours.
#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "core/mesh/mesh.h"

namespace coppice::test {

// The distance of each point to the mesh (AABB tree).
std::vector<double> cgal_distances(const Mesh& mesh, const std::vector<Vec3d>& points);

// The two below take manifolds, and give nothing for other meshes.

// max over `from` of the distance to `to`, to within error.
std::optional<double> cgal_one_sided_hausdorff(const Mesh& from, const Mesh& to, double error);

// Pairs of triangles that intersect elsewhere than in what they share.
std::optional<size_t> cgal_self_intersections(const Mesh& mesh);

}  // namespace coppice::test
