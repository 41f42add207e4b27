#include "core/format/gltf/trs.h"

#include <algorithm>
#include <cmath>

namespace coppice::gltf {

namespace {

using Matrix3 = std::array<std::array<double, 3>, 3>;  // rows

Vec3d column(const Matrix3& m, size_t c) {
    return {m[0][c], m[1][c], m[2][c]};
}

void set_column(Matrix3& m, size_t c, Vec3d v) {
    m[0][c] = v.x;
    m[1][c] = v.y;
    m[2][c] = v.z;
}

Matrix3 linear_part(const Transform& t) {
    return {{{t.m[0], t.m[1], t.m[2]}, {t.m[4], t.m[5], t.m[6]}, {t.m[8], t.m[9], t.m[10]}}};
}

// Shepperd's method. For a rotation the result has unit length; for other matrices it is whatever comes out,
// as the validator has it.
std::array<double, 4> quaternion(const Matrix3& m) {
    std::array<double, 4> q{};
    const double trace = m[0][0] + m[1][1] + m[2][2];
    if (trace > 0) {
        const double s = std::sqrt(trace + 1);
        q = {(m[2][1] - m[1][2]) * 0.5 / s, (m[0][2] - m[2][0]) * 0.5 / s, (m[1][0] - m[0][1]) * 0.5 / s,
             s * 0.5};
        return q;
    }
    const size_t i = m[0][0] < m[1][1] ? (m[1][1] < m[2][2] ? 2 : 1) : (m[0][0] < m[2][2] ? 2 : 0);
    const size_t j = (i + 1) % 3;
    const size_t k = (i + 2) % 3;
    const double s = std::sqrt(m[i][i] - m[j][j] - m[k][k] + 1);
    q[i] = s * 0.5;
    q[3] = (m[k][j] - m[j][k]) * 0.5 / s;
    q[j] = (m[j][i] + m[i][j]) * 0.5 / s;
    q[k] = (m[k][i] + m[i][k]) * 0.5 / s;
    return q;
}

std::array<double, 4> unit(std::array<double, 4> q) {
    double length = std::sqrt(q[0] * q[0] + q[1] * q[1] + q[2] * q[2] + q[3] * q[3]);
    if (q[3] < 0) length = -length;
    for (double& v : q) v /= length;
    return q;
}

// Rotation times scale, when the columns are perpendicular.
std::optional<Trs> decompose(const Matrix3& m, Vec3d translation, double tolerance) {
    std::array<Vec3d, 3> columns = {column(m, 0), column(m, 1), column(m, 2)};
    std::array<double, 3> scale = {length(columns[0]), length(columns[1]), length(columns[2])};
    if (!(std::min({scale[0], scale[1], scale[2]}) > 0)) return std::nullopt;
    if (dot(cross(columns[0], columns[1]), columns[2]) < 0) scale[0] = -scale[0];
    Matrix3 rotation{};
    for (size_t c = 0; c < 3; ++c) set_column(rotation, c, columns[c] * (1 / scale[c]));
    for (size_t c = 0; c < 3; ++c)
        if (std::abs(dot(column(rotation, c), column(rotation, (c + 1) % 3))) > tolerance)
            return std::nullopt;
    return Trs{translation, unit(quaternion(rotation)), {scale[0], scale[1], scale[2]}};
}

// One-sided Jacobi: rotates the columns of a until they are perpendicular; v collects the rotations, so m = a
// v'.
void perpendicular_columns(Matrix3& a, Matrix3& v) {
    for (int sweep = 0; sweep < 60; ++sweep) {
        double worst = 0;
        for (size_t p = 0; p < 2; ++p)
            for (size_t q = p + 1; q < 3; ++q) {
                const Vec3d x = column(a, p);
                const Vec3d y = column(a, q);
                const double xy = dot(x, y);
                if (xy == 0) continue;
                worst = std::max(worst, std::abs(xy) / (length(x) * length(y)));
                const double zeta = (dot(y, y) - dot(x, x)) / (2 * xy);
                const double t = (zeta >= 0 ? 1 : -1) / (std::abs(zeta) + std::sqrt(1 + zeta * zeta));
                const double c = 1 / std::sqrt(1 + t * t);
                const double s = c * t;
                for (Matrix3* m : {&a, &v}) {
                    const Vec3d mp = column(*m, p);
                    const Vec3d mq = column(*m, q);
                    set_column(*m, p, mp * c - mq * s);
                    set_column(*m, q, mp * s + mq * c);
                }
            }
        if (worst < 1e-15) return;
    }
}

// The sum over rows of absolute values, largest over columns, as the validator's matrix library has it.
double norm(const std::array<double, 16>& m) {
    double largest = 0;
    for (size_t c = 0; c < 4; ++c)
        largest = std::max(largest, std::abs(m[4 * c]) + std::abs(m[4 * c + 1]) + std::abs(m[4 * c + 2]) +
                                        std::abs(m[4 * c + 3]));
    return largest;
}

std::array<double, 16> compose_as_is(const std::array<double, 4>& q, const std::array<double, 3>& scale,
                                     const std::array<double, 16>& translation_of) {
    const auto [x, y, z, w] = q;
    std::array<double, 16> m = translation_of;
    const Matrix3 r = {{{1 - 2 * (y * y + z * z), 2 * (x * y - z * w), 2 * (x * z + y * w)},
                        {2 * (x * y + z * w), 1 - 2 * (x * x + z * z), 2 * (y * z - x * w)},
                        {2 * (x * z - y * w), 2 * (y * z + x * w), 1 - 2 * (x * x + y * y)}}};
    for (size_t c = 0; c < 3; ++c)
        for (size_t row = 0; row < 3; ++row) m[4 * c + row] = r[row][c] * scale[c];
    return m;
}

}  // namespace

std::optional<Trs> decompose(const Transform& transform) {
    return decompose(linear_part(transform), {transform.m[3], transform.m[7], transform.m[11]}, 1e-6);
}

std::optional<std::pair<Trs, Trs>> decompose_in_two(const Transform& transform) {
    Matrix3 a = linear_part(transform);
    Matrix3 v = {{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}};
    perpendicular_columns(a, v);
    // a = U S, so the transform is (translation, U, S) after the rotation V'.
    Matrix3 inverse{};
    for (size_t r = 0; r < 3; ++r)
        for (size_t c = 0; c < 3; ++c) inverse[r][c] = v[c][r];
    auto outer = decompose(a, {transform.m[3], transform.m[7], transform.m[11]}, 1e-6);
    auto inner = decompose(inverse, {}, 1e-6);
    if (!outer || !inner) return std::nullopt;
    return std::pair{*outer, *inner};
}

bool is_valid_node_matrix(const std::array<double, 16>& m) {
    if (m[3] != 0 || m[7] != 0 || m[11] != 0 || m[15] != 1) return false;
    const Matrix3 rows = {{{m[0], m[4], m[8]}, {m[1], m[5], m[9]}, {m[2], m[6], m[10]}}};
    const double volume = dot(cross(column(rows, 0), column(rows, 1)), column(rows, 2));
    if (volume == 0 || !std::isfinite(volume)) return false;
    std::array<double, 3> scale = {length(column(rows, 0)), length(column(rows, 1)), length(column(rows, 2))};
    if (volume < 0) scale[0] = -scale[0];
    Matrix3 rotation{};
    for (size_t c = 0; c < 3; ++c) set_column(rotation, c, column(rows, c) * (1 / scale[c]));
    const auto composed = compose_as_is(quaternion(rotation), scale, m);
    return std::abs(norm(m) - norm(composed)) < 0.00005;
}

}  // namespace coppice::gltf
