// A quadric about a point of its own: E(d) = d'Ad + 2 b'd + c, where d is measured from that point. Single
// precision is enough for it however far the mesh is from the origin, and half the memory is half the time.
#pragma once

#include <algorithm>
#include <optional>

#include "core/mesh/vec.h"

namespace coppice {

struct CentredQuadric {
    float xx = 0, yy = 0, zz = 0, xy = 0, xz = 0, yz = 0;  // A, symmetric
    Vec3f b;
    float c = 0;
    float weight = 0;  // of the planes in it: E / weight is a mean squared distance

    CentredQuadric& operator+=(const CentredQuadric& q) {
        xx += q.xx, yy += q.yy, zz += q.zz, xy += q.xy, xz += q.xz, yz += q.yz;
        b = b + q.b;
        c += q.c;
        weight += q.weight;
        return *this;
    }

    Vec3f times(Vec3f d) const {  // Ad
        return {xx * d.x + xy * d.y + xz * d.z, xy * d.x + yy * d.y + yz * d.z,
                xz * d.x + yz * d.y + zz * d.z};
    }

    float operator()(Vec3f d) const { return std::max(0.0F, dot(times(d) + b * 2, d) + c); }

    // The same about a point from which this one's is at `offset`.
    CentredQuadric seen_from(Vec3f offset) const {
        CentredQuadric q = *this;
        const Vec3f moved = times(offset);
        q.b = b - moved;
        q.c = c + dot(moved - b * 2, offset);
        return q;
    }

    // Adds weight * n n', without touching `weight`.
    void add_square(Vec3f n, float w) {
        xx += w * n.x * n.x, yy += w * n.y * n.y, zz += w * n.z * n.z;
        xy += w * n.x * n.y, xz += w * n.x * n.z, yz += w * n.y * n.z;
    }
};

// One linear condition on a point: normal . d = offset. The zero normal holds nothing.
struct Constraint {
    Vec3f normal;
    float offset = 0;
};

// Where the quadric is least among the points that keep the condition. A spring to `rest`, as strong as
// `stiffness`, decides where planes do not. None where it has no one solution.
inline std::optional<Vec3f> least_point(const CentredQuadric& q, float stiffness, Vec3f rest,
                                        const Constraint& keep) {
    const float a = q.xx + stiffness, b = q.yy + stiffness, c = q.zz + stiffness;
    const float minor_x = b * c - q.yz * q.yz, minor_y = q.xz * q.yz - q.xy * c,
                minor_z = q.xy * q.yz - q.xz * b;
    const float determinant = a * minor_x + q.xy * minor_y + q.xz * minor_z;
    if (!(determinant > 1e-12F * q.weight * q.weight * q.weight)) return {};
    const float minor_yy = a * c - q.xz * q.xz, minor_yz = q.xy * q.xz - a * q.yz,
                minor_zz = a * b - q.xy * q.xy;
    const float inverse = 1 / determinant;
    const auto solved = [&](Vec3f right) {
        return Vec3f{minor_x * right.x + minor_y * right.y + minor_z * right.z,
                     minor_y * right.x + minor_yy * right.y + minor_yz * right.z,
                     minor_z * right.x + minor_yz * right.y + minor_zz * right.z} *
               inverse;
    };
    const Vec3f free = solved(rest * stiffness - q.b);
    if (keep.normal == Vec3f{}) return free;
    // Lagrange: A d = -b + lambda n.
    const Vec3f step = solved(keep.normal);
    const float along = dot(keep.normal, step);
    return along > 0 ? free + step * ((keep.offset - dot(keep.normal, free)) / along) : free;
}

}  // namespace coppice
