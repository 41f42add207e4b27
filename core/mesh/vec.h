// Small vectors. Positions are stored as Vec3f and computed with as Vec3d.
#pragma once

#include <cmath>

namespace coppice {

template <typename T>
struct Vec3 {
    T x = {}, y = {}, z = {};

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

template <typename T>
T dot(Vec3<T> a, Vec3<T> b) {
    return a.x * b.x + a.y * b.y + a.z * b.z;
}
template <typename T>
Vec3<T> cross(Vec3<T> a, Vec3<T> b) {
    return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
// Of the triangle (a, b, c), counter-clockwise. Its length is twice the area.
template <typename T>
Vec3<T> area_normal(Vec3<T> a, Vec3<T> b, Vec3<T> c) {
    return cross(b - a, c - a);
}
template <typename T>
T squared_length(Vec3<T> v) {
    return dot(v, v);
}
template <typename T>
T length(Vec3<T> v) {
    return std::sqrt(dot(v, v));
}
// The zero vector stays zero.
template <typename T>
Vec3<T> normalized(Vec3<T> v) {
    const T l = length(v);
    return l > 0 ? v * (1 / l) : v;
}

}  // namespace coppice
