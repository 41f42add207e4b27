// A quadric about a point of its own: E(d) = d'Ad + 2 b'd + c, where d is measured from that point. Single
// precision is enough for it however far the mesh is from the origin, and half the memory is half the time.
#pragma once

#include "core/mesh/vec.h"

namespace coppice {

// T: float, or Lanes for several at once.
template <typename T>
struct BasicQuadric {
    T xx = {}, yy = {}, zz = {}, xy = {}, xz = {}, yz = {};  // A, symmetric
    Vec3<T> b;
    T c = {};
    T weight = {};  // of the planes in it: E / weight is a mean squared distance

    BasicQuadric& operator+=(const BasicQuadric& q) {
        xx += q.xx, yy += q.yy, zz += q.zz, xy += q.xy, xz += q.xz, yz += q.yz;
        b = b + q.b;
        c += q.c;
        weight += q.weight;
        return *this;
    }

    Vec3<T> times(Vec3<T> d) const {  // Ad
        return {xx * d.x + xy * d.y + xz * d.z, xy * d.x + yy * d.y + yz * d.z,
                xz * d.x + yz * d.y + zz * d.z};
    }

    // Never less than 0, but for rounding.
    T operator()(Vec3<T> d) const { return dot(times(d) + b + b, d) + c; }

    // The same about a point from which this one's is at `offset`.
    BasicQuadric seen_from(Vec3<T> offset) const {
        BasicQuadric q = *this;
        const Vec3<T> moved = times(offset);
        q.b = b - moved;
        q.c = c + dot(moved - b - b, offset);
        return q;
    }

    // Adds w * n n', without touching `weight`.
    void add_square(Vec3<T> n, T w) {
        const Vec3<T> scaled = n * w;
        xx += scaled.x * n.x, yy += scaled.y * n.y, zz += scaled.z * n.z;
        xy += scaled.x * n.y, xz += scaled.x * n.z, yz += scaled.y * n.z;
    }
};

using CentredQuadric = BasicQuadric<float>;

// One linear condition on a point: normal . d = offset. The zero normal holds nothing.
template <typename T>
struct Constraint {
    Vec3<T> normal = {};
    T offset = {};
};

// Enough to keep flat regions well shaped, too little to be seen elsewhere.
inline constexpr float spring_of_weight = 1e-4F;

template <typename T>
Vec3<T> chosen(auto mask, Vec3<T> a, Vec3<T> b) {
    return {mask ? a.x : b.x, mask ? a.y : b.y, mask ? a.z : b.z};
}

// The best of both ends of an edge from the origin to `offset`, and its middle.
template <typename T>
Vec3<T> best_of_edge(const BasicQuadric<T>& q, Vec3<T> offset) {
    const T half = T{} + 0.5F;
    const Vec3<T> middle = offset * half;
    const T at_start = q.c, at_end = q(offset), at_middle = q(middle);
    const auto start_is_better = at_start <= at_end;
    const Vec3<T> end = chosen(start_is_better, Vec3<T>{}, offset);
    return chosen(at_middle <= (start_is_better ? at_start : at_end), middle, end);
}

// Where the quadric is least, among the points that keep the condition if there is one. A weak spring to the
// middle of the edge decides where planes do not. Where there is no one solution, or one that is far away:
// the best of the edge.
template <typename T>
Vec3<T> least_point(const BasicQuadric<T>& q, Vec3<T> offset, const Constraint<T>* keep) {
    const T half = T{} + 0.5F, spring = T{} + spring_of_weight, scale = 1 / q.weight;
    const Vec3<T> middle = offset * half;
    const T a = q.xx * scale + spring, b = q.yy * scale + spring, c = q.zz * scale + spring;
    const T xy = q.xy * scale, xz = q.xz * scale, yz = q.yz * scale;
    const T minor_x = b * c - yz * yz, minor_y = xz * yz - xy * c, minor_z = xy * yz - xz * b;
    const T minor_yy = a * c - xz * xz, minor_yz = xy * xz - a * yz, minor_zz = a * b - xy * xy;
    const T determinant = a * minor_x + xy * minor_y + xz * minor_z;
    const T inverse = 1 / determinant;
    const auto solved = [&](Vec3<T> right) {
        return Vec3<T>{minor_x * right.x + minor_y * right.y + minor_z * right.z,
                       minor_y * right.x + minor_yy * right.y + minor_yz * right.z,
                       minor_z * right.x + minor_yz * right.y + minor_zz * right.z} *
               inverse;
    };
    Vec3<T> point = solved(middle * spring - q.b * scale);
    if (keep != nullptr) {  // Lagrange: A d = -b + lambda n
        const Vec3<T> step = solved(keep->normal);
        const T along = dot(keep->normal, step), off = keep->offset - dot(keep->normal, point);
        point = point + step * (along > 0 ? off / along : T{});
    }
    const T reach = squared_length(offset) * 4;
    const auto is_sound = (determinant > 1e-12F) & (squared_length(point - middle) <= reach);
    return chosen(is_sound, point, best_of_edge(q, offset));
}

}  // namespace coppice
