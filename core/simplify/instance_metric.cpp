#include "core/simplify/instance_metric.h"

#include <algorithm>
#include <cmath>

namespace coppice {

namespace {

// Transforms are often stored as floats: what differs by no more than that is not stretched.
constexpr double rounding = 1e-5;
// A mean instance that is flat has no inverse. No direction counts less than this part of the mean.
constexpr double least_stretch = 1e-6;

struct Symmetric {
    double xx = 0, yy = 0, zz = 0, xy = 0, yz = 0, zx = 0;

    double mean() const { return (xx + yy + zz) / 3; }
    double determinant() const {
        return xx * (yy * zz - yz * yz) - xy * (xy * zz - yz * zx) + zx * (xy * yz - yy * zx);
    }
    bool is_multiple_of_identity() const {
        const double most = std::max({std::abs(xx - mean()), std::abs(yy - mean()), std::abs(zz - mean()),
                                      std::abs(xy), std::abs(yz), std::abs(zx)});
        return !(most > rounding * mean());
    }
};

// The sum of L' L.
Symmetric sum_of_squares(std::span<const Transform> instances) {
    Symmetric g;
    for (const Transform& instance : instances) {
        for (size_t row = 0; row < 12; row += 4) {
            const double x = instance.m[row], y = instance.m[row + 1], z = instance.m[row + 2];
            g.xx += x * x, g.yy += y * y, g.zz += z * z;
            g.xy += x * y, g.yz += y * z, g.zx += z * x;
        }
    }
    return g;
}

}  // namespace

InstanceMetric::InstanceMetric(std::span<const Transform> instances) {
    Symmetric g = sum_of_squares(instances);
    if (!std::isfinite(g.mean()) || g.is_multiple_of_identity()) return;
    const double floor = least_stretch * g.mean();
    g.xx += floor, g.yy += floor, g.zz += floor;
    const double determinant = g.determinant();
    if (!std::isfinite(determinant) || !(determinant > 0)) return;
    const double root = std::cbrt(determinant);
    metric_ = {g.xx / root, g.yy / root, g.zz / root, g.xy / root, g.yz / root, g.zx / root};
    const double scale = root / determinant;  // the inverse is the adjugate over the determinant
    inverse_ = {scale * (g.yy * g.zz - g.yz * g.yz), scale * (g.xx * g.zz - g.zx * g.zx),
                scale * (g.xx * g.yy - g.xy * g.xy), scale * (g.yz * g.zx - g.xy * g.zz),
                scale * (g.xy * g.zx - g.yz * g.xx), scale * (g.xy * g.yz - g.zx * g.yy)};
    is_identity_ = false;
}

Vec3d InstanceMetric::dual(Vec3d d) const {
    if (is_identity_) return d;
    const auto& [xx, yy, zz, xy, yz, zx] = metric_;
    return {xx * d.x + xy * d.y + zx * d.z, xy * d.x + yy * d.y + yz * d.z, zx * d.x + yz * d.y + zz * d.z};
}

double InstanceMetric::shrink(Vec3d n) const {
    if (is_identity_) return 1;
    const auto& [xx, yy, zz, xy, yz, zx] = inverse_;
    const double squared = xx * n.x * n.x + yy * n.y * n.y + zz * n.z * n.z +
                           2 * (xy * n.x * n.y + yz * n.y * n.z + zx * n.z * n.x);
    return squared > 0 ? std::sqrt(squared) : 1;
}

}  // namespace coppice
