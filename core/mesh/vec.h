// Small vectors. Positions are stored as Vec3f and computed with as Vec3d.
#pragma once

#include <cmath>

namespace coppice {

template <typename T>
struct Vec3 {
    T x = 0, y = 0, z = 0;

    friend bool operator==(const Vec3&, const Vec3&) = default;
    friend Vec3 operator+(Vec3 a, Vec3 b) { return {a.x + b.x, a.y + b.y, a.z + b.z}; }
    friend Vec3 operator-(Vec3 a, Vec3 b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
    friend Vec3 operator*(Vec3 a, T s) { return {a.x * s, a.y * s, a.z * s}; }
};

using Vec3f = Vec3<float>;
using Vec3d = Vec3<double>;

inline Vec3d to_double(Vec3f v) {
    return {v.x, v.y, v.z};
}
inline Vec3f to_float(Vec3d v) {
    return {static_cast<float>(v.x), static_cast<float>(v.y), static_cast<float>(v.z)};
}

inline double dot(Vec3d a, Vec3d b) {
    return a.x * b.x + a.y * b.y + a.z * b.z;
}
inline Vec3d cross(Vec3d a, Vec3d b) {
    return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
// Of the triangle (a, b, c), counter-clockwise. Its length is twice the area.
inline Vec3d area_normal(Vec3d a, Vec3d b, Vec3d c) {
    return cross(b - a, c - a);
}
inline double squared_length(Vec3d v) {
    return dot(v, v);
}
inline double length(Vec3d v) {
    return std::sqrt(dot(v, v));
}
// The zero vector stays zero.
inline Vec3d normalized(Vec3d v) {
    const double l = length(v);
    return l > 0 ? v * (1 / l) : v;
}

}  // namespace coppice
