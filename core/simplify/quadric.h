// Q(p) = p'Ap + 2b'p + c: a weighted sum of squared distances to planes. Garland and Heckbert 1997.
#pragma once

#include "core/mesh/vec.h"

namespace coppice {

struct Quadric {
    double xx = 0, xy = 0, xz = 0, yy = 0, yz = 0, zz = 0;  // A, symmetric
    double bx = 0, by = 0, bz = 0;
    double c = 0;

    Quadric& operator+=(const Quadric& q) {
        xx += q.xx, xy += q.xy, xz += q.xz, yy += q.yy, yz += q.yz, zz += q.zz;
        bx += q.bx, by += q.by, bz += q.bz;
        c += q.c;
        return *this;
    }
    friend Quadric operator+(Quadric a, const Quadric& b) { return a += b; }

    // The weighted sum at p. Rounding can make it slightly negative; never less than 0 here.
    double operator()(Vec3d p) const {
        const double x = xx * p.x + xy * p.y + xz * p.z + 2 * bx;
        const double y = xy * p.x + yy * p.y + yz * p.z + 2 * by;
        const double z = xz * p.x + yz * p.y + zz * p.z + 2 * bz;
        const double value = x * p.x + y * p.y + z * p.z + c;
        return value > 0 ? value : 0;
    }
};

// K_f of the plane through `point` with the unit normal n, times a weight. The zero normal gives the zero
// quadric.
inline Quadric plane_quadric(Vec3d n, Vec3d point, double weight) {
    const double d = -dot(n, point);
    return {weight * n.x * n.x, weight * n.x * n.y, weight * n.x * n.z, weight * n.y * n.y,
            weight * n.y * n.z, weight * n.z * n.z, weight * n.x * d,   weight * n.y * d,
            weight * n.z * d,   weight * d * d};
}

}  // namespace coppice
