// Affine maps: translation, rotation, non-uniform scale, shear, mirroring.
#pragma once

#include <array>
#include <span>

#include "core/mesh/bounds.h"
#include "core/mesh/mesh.h"

namespace coppice {

// Row-major 3x4: p' = (m[0..2] . p + m[3], ...). Column vectors; the fourth row is 0 0 0 1.
struct Transform {
    std::array<double, 12> m = {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0};

    friend bool operator==(const Transform&, const Transform&) = default;

    Vec3d point(Vec3d p) const;      // with the translation
    Vec3d direction(Vec3d d) const;  // without it
    bool is_finite() const;
};

// Applies b first, then a.
Transform operator*(const Transform& a, const Transform& b);

// glTF's TRS; the quaternion is x y z w and is normalized first (an all-zero one counts as the identity).
Transform from_trs(Vec3d translation, std::array<double, 4> rotation, Vec3d scale);
// glTF's column-major 4x4; the last row is taken as 0 0 0 1.
Transform from_column_major(std::span<const double, 16> matrix);
std::array<double, 16> to_column_major(const Transform& transform);

double determinant(const Transform& transform);    // of the linear part; < 0 mirrors
double largest_scale(const Transform& transform);  // largest singular value of the linear part
// The largest of them; 0 for none. Much cheaper than asking each, which matters for thousands of instances.
double largest_scale(std::span<const Transform> transforms);
// Normals transform by the inverse transpose of the linear part; unit length, or zero where that is singular.
Vec3d transform_normal(const Transform& transform, Vec3d normal);
Bounds transform_bounds(const Transform& transform, const Bounds& box);  // box of the eight corners

// Moves a mesh: positions and morph deltas by the map, normals by the inverse transpose, tangents by the
// linear part; the winding is flipped for negative determinants (and the tangent's handedness with it).
// Storage becomes float32.
void transform_mesh(const Transform& transform, Mesh& mesh);

}  // namespace coppice
