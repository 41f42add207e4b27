#include "core/compare/orientation.h"

#include <array>
#include <cmath>
#include <cstddef>

namespace coppice {

namespace {

// A sum that is kept exactly, as doubles that do not overlap, smallest first.
template <size_t most>
class ExactSum {
  public:
    void add(double value) {
        size_t kept = 0;
        for (size_t i = 0; i < size_; ++i) {
            const double sum = value + parts_[i];
            const double virtual_part = sum - value;
            const double rest = (value - (sum - virtual_part)) + (parts_[i] - virtual_part);
            if (rest != 0) parts_[kept++] = rest;
            value = sum;
        }
        if (value != 0) parts_[kept++] = value;
        size_ = kept;
    }

    // The largest part has the sum's sign.
    int sign() const { return size_ == 0 ? 0 : (parts_[size_ - 1] > 0 ? 1 : -1); }

  private:
    std::array<double, most> parts_{};
    size_t size_ = 0;
};

// Floats have 24 digits: a product of two is a double, and that of three is a double and what it lacks.
void add_product(double x, double y, double z, ExactSum<64>& sum) {
    const double xy = x * y;
    const double high = xy * z;
    sum.add(std::fma(xy, z, -high));
    sum.add(high);
}

// sign * x (y z' - z y') of three points.
void add_determinant(Vec3d a, Vec3d b, Vec3d c, double sign, ExactSum<64>& sum) {
    const Vec3d s = a * sign;
    add_product(s.x, b.y, c.z, sum);
    add_product(-s.x, b.z, c.y, sum);
    add_product(s.y, b.z, c.x, sum);
    add_product(-s.y, b.x, c.z, sum);
    add_product(s.z, b.x, c.y, sum);
    add_product(-s.z, b.y, c.x, sum);
}

int exact_orientation(Vec3d a, Vec3d b, Vec3d c, Vec3d d) {
    // det(a - d, b - d, c - d), expanded by the column of ones.
    ExactSum<64> sum;
    add_determinant(a, b, c, 1, sum);
    add_determinant(a, b, d, -1, sum);
    add_determinant(a, c, d, 1, sum);
    add_determinant(b, c, d, -1, sum);
    return sum.sign();
}

int sign(double value) {
    return value > 0 ? 1 : (value < 0 ? -1 : 0);
}

constexpr double epsilon = 0x1p-53;

}  // namespace

int orientation(Vec3f fa, Vec3f fb, Vec3f fc, Vec3f fd) {
    const Vec3d a = to_double(fa), b = to_double(fb), c = to_double(fc), d = to_double(fd);
    const Vec3d ad = a - d, bd = b - d, cd = c - d;
    const double bxcy = bd.x * cd.y, cxby = cd.x * bd.y;
    const double cxay = cd.x * ad.y, axcy = ad.x * cd.y;
    const double axby = ad.x * bd.y, bxay = bd.x * ad.y;
    const double determinant = ad.z * (bxcy - cxby) + bd.z * (cxay - axcy) + cd.z * (axby - bxay);
    const double permanent = (std::abs(bxcy) + std::abs(cxby)) * std::abs(ad.z) +
                             (std::abs(cxay) + std::abs(axcy)) * std::abs(bd.z) +
                             (std::abs(axby) + std::abs(bxay)) * std::abs(cd.z);
    const double bound = (7 + 56 * epsilon) * epsilon * permanent;  // Shewchuk's first filter
    if (determinant > bound || -determinant > bound) return sign(determinant);
    return exact_orientation(a, b, c, d);
}

int orientation(Point2f a, Point2f b, Point2f c) {
    ExactSum<8> sum;
    const auto add = [&sum](double x, double y) { sum.add(x * y); };  // exact: both were floats
    add(a.x, b.y);
    add(-double{a.x}, c.y);
    add(b.x, c.y);
    add(-double{b.x}, a.y);
    add(c.x, a.y);
    add(-double{c.x}, b.y);
    return sum.sign();
}

}  // namespace coppice
