#include "core/scene/transform.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <utility>

namespace coppice {

namespace {

// Rows of the cofactor matrix of the linear part: det(L) * L^-T. Its sign is handled by the callers.
std::array<Vec3d, 3> cofactor_rows(const Transform& t) {
    const Vec3d c0 = {t.m[0], t.m[4], t.m[8]};
    const Vec3d c1 = {t.m[1], t.m[5], t.m[9]};
    const Vec3d c2 = {t.m[2], t.m[6], t.m[10]};
    const Vec3d x = cross(c1, c2);
    const Vec3d y = cross(c2, c0);
    const Vec3d z = cross(c0, c1);
    return {Vec3d{x.x, y.x, z.x}, Vec3d{x.y, y.y, z.y}, Vec3d{x.z, y.z, z.z}};
}

Vec3d value_at(const Attribute& attribute, size_t wedge) {
    const float* v = attribute.values.data() + wedge * attribute.components;
    return {v[0], v[1], v[2]};
}

void set_value(Attribute& attribute, size_t wedge, Vec3d value) {
    float* v = attribute.values.data() + wedge * attribute.components;
    const Vec3f f = to_float(value);
    v[0] = f.x;
    v[1] = f.y;
    v[2] = f.z;
}

template <typename Map>
void map_values(Attribute& attribute, size_t wedges, Map map) {
    for (size_t w = 0; w < wedges; ++w) set_value(attribute, w, map(value_at(attribute, w)));
    attribute.storage = {};
}

void transform_attribute(const Transform& transform, size_t wedges, Attribute& attribute) {
    if (attribute.name == "NORMAL") {
        map_values(attribute, wedges, [&](Vec3d n) { return transform_normal(transform, n); });
    } else if (attribute.name == "TANGENT" && attribute.components == 4) {
        map_values(attribute, wedges, [&](Vec3d t) { return normalized(transform.direction(t)); });
        if (determinant(transform) < 0) {
            for (size_t w = 0; w < wedges; ++w) attribute.values[4 * w + 3] *= -1;
        }
    }
}

// Deltas are differences: positions and tangents by the linear part, normals by det(L) L^-T scaled to keep
// lengths under rotations, which is what an unnormalized sum of normals needs.
void transform_delta(const Transform& transform, size_t wedges, Attribute& delta) {
    if (delta.name == "POSITION" || delta.name == "TANGENT") {
        map_values(delta, wedges, [&](Vec3d d) { return transform.direction(d); });
    } else if (delta.name == "NORMAL") {
        map_values(delta, wedges, [&](Vec3d d) { return transform_normal(transform, d) * length(d); });
    }
}

}  // namespace

Vec3d Transform::direction(Vec3d d) const {
    return {m[0] * d.x + m[1] * d.y + m[2] * d.z, m[4] * d.x + m[5] * d.y + m[6] * d.z,
            m[8] * d.x + m[9] * d.y + m[10] * d.z};
}

Vec3d Transform::point(Vec3d p) const {
    return direction(p) + Vec3d{m[3], m[7], m[11]};
}

bool Transform::is_finite() const {
    return std::all_of(m.begin(), m.end(), [](double v) { return std::isfinite(v); });
}

Transform operator*(const Transform& a, const Transform& b) {
    Transform product;
    for (size_t row = 0; row < 3; ++row) {
        for (size_t column = 0; column < 4; ++column) {
            double sum = column == 3 ? a.m[4 * row + 3] : 0;
            for (size_t k = 0; k < 3; ++k) sum += a.m[4 * row + k] * b.m[4 * k + column];
            product.m[4 * row + column] = sum;
        }
    }
    return product;
}

Transform from_trs(Vec3d translation, std::array<double, 4> rotation, Vec3d scale) {
    Eigen::Quaterniond q(rotation[3], rotation[0], rotation[1], rotation[2]);
    q = q.norm() > 0 ? q.normalized() : Eigen::Quaterniond::Identity();
    const Eigen::Matrix3d r = q.toRotationMatrix() * Eigen::Vector3d(scale.x, scale.y, scale.z).asDiagonal();
    return {{r(0, 0), r(0, 1), r(0, 2), translation.x,  //
             r(1, 0), r(1, 1), r(1, 2), translation.y,  //
             r(2, 0), r(2, 1), r(2, 2), translation.z}};
}

Transform from_column_major(std::span<const double, 16> matrix) {
    Transform t;
    for (size_t row = 0; row < 3; ++row) {
        for (size_t column = 0; column < 4; ++column) t.m[4 * row + column] = matrix[4 * column + row];
    }
    return t;
}

std::array<double, 16> to_column_major(const Transform& transform) {
    std::array<double, 16> matrix = {};
    for (size_t row = 0; row < 3; ++row) {
        for (size_t column = 0; column < 4; ++column)
            matrix[4 * column + row] = transform.m[4 * row + column];
    }
    matrix[15] = 1;
    return matrix;
}

double determinant(const Transform& t) {
    return dot(Vec3d{t.m[0], t.m[1], t.m[2]},
               cross(Vec3d{t.m[4], t.m[5], t.m[6]}, Vec3d{t.m[8], t.m[9], t.m[10]}));
}

double largest_scale(const Transform& transform) {
    const auto& m = transform.m;
    Eigen::Matrix3d linear;
    linear << m[0], m[1], m[2], m[4], m[5], m[6], m[8], m[9], m[10];
    return Eigen::JacobiSVD<Eigen::Matrix3d>(linear).singularValues()(0);
}

namespace {

// Never below the square of the largest singular value, and equal to it where the map scales uniformly: with
// B = L'L, the eigenvalues of B differ from their mean by at most sqrt(2/3) |B - mean I| (Frobenius norm).
double squared_scale_bound(const Transform& transform) {
    const auto& m = transform.m;
    const Vec3d x = {m[0], m[4], m[8]}, y = {m[1], m[5], m[9]}, z = {m[2], m[6], m[10]};
    const double xx = dot(x, x), yy = dot(y, y), zz = dot(z, z), xy = dot(x, y), yz = dot(y, z),
                 zx = dot(z, x);
    const double mean = (xx + yy + zz) / 3;
    const auto square = [](double v) { return v * v; };
    const double off = square(xx - mean) + square(yy - mean) + square(zz - mean) +
                       2 * (square(xy) + square(yz) + square(zx));
    return mean + std::sqrt(2.0 / 3 * off);
}

}  // namespace

double largest_scale(std::span<const Transform> transforms) {
    double largest = 0;
    for (const Transform& transform : transforms) {
        // Turned around, so that one whose squares are too large for a number is asked, too.
        if (!(squared_scale_bound(transform) <= largest * largest * (1 + 1e-12))) {
            largest = std::max(largest, largest_scale(transform));
        }
    }
    return largest;
}

Vec3d transform_normal(const Transform& transform, Vec3d normal) {
    const auto rows = cofactor_rows(transform);
    // cofactor = det * L^-T: mirrored maps turn it around, which the sign undoes.
    const double sign = determinant(transform) < 0 ? -1 : 1;
    return normalized(Vec3d{dot(rows[0], normal), dot(rows[1], normal), dot(rows[2], normal)} * sign);
}

Bounds transform_bounds(const Transform& transform, const Bounds& box) {
    Bounds result;
    if (box.empty()) return result;
    for (int corner = 0; corner < 8; ++corner) {
        result.extend(transform.point({(corner & 1) != 0 ? box.max.x : box.min.x,
                                       (corner & 2) != 0 ? box.max.y : box.min.y,
                                       (corner & 4) != 0 ? box.max.z : box.min.z}));
    }
    return result;
}

void transform_mesh(const Transform& transform, Mesh& mesh) {
    for (Vec3f& position : mesh.positions) position = to_float(transform.point(to_double(position)));
    mesh.position_storage = {};
    for (Attribute& attribute : mesh.attributes)
        transform_attribute(transform, mesh.wedge_count(), attribute);
    for (MorphTarget& target : mesh.morph_targets) {
        for (Attribute& delta : target.deltas) transform_delta(transform, mesh.wedge_count(), delta);
    }
    if (determinant(transform) < 0) {
        for (size_t t = 0; t < mesh.triangle_count(); ++t) {
            std::swap(mesh.triangles[3 * t + 1], mesh.triangles[3 * t + 2]);
        }
    }
}

}  // namespace coppice
