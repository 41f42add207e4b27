#include "core/simplify/instance_weights.h"

#include <algorithm>
#include <cmath>

namespace coppice {

namespace {

using Linear = std::array<double, 9>;  // row-major

Linear linear_part(const Transform& t) {
    return {t.m[0], t.m[1], t.m[2], t.m[4], t.m[5], t.m[6], t.m[8], t.m[9], t.m[10]};
}

Linear cofactors(const Linear& l) {
    return {l[4] * l[8] - l[5] * l[7], l[5] * l[6] - l[3] * l[8], l[3] * l[7] - l[4] * l[6],
            l[2] * l[7] - l[1] * l[8], l[0] * l[8] - l[2] * l[6], l[1] * l[6] - l[0] * l[7],
            l[1] * l[5] - l[2] * l[4], l[2] * l[3] - l[0] * l[5], l[0] * l[4] - l[1] * l[3]};
}

// The squared scale of a similarity: columns are orthogonal and equally long. Negative for what is none.
double squared_scale(const Linear& l) {
    const Vec3d x = {l[0], l[3], l[6]}, y = {l[1], l[4], l[7]}, z = {l[2], l[5], l[8]};
    const double xx = squared_length(x), yy = squared_length(y), zz = squared_length(z);
    const double tolerance = 1e-6 * std::max({xx, yy, zz});
    const bool similar = std::abs(xx - yy) <= tolerance && std::abs(yy - zz) <= tolerance &&
                         std::abs(dot(x, y)) <= tolerance && std::abs(dot(y, z)) <= tolerance &&
                         std::abs(dot(z, x)) <= tolerance;
    return similar ? (xx + yy + zz) / 3 : -1;
}

}  // namespace

InstanceWeights::InstanceWeights(std::span<const Transform> instances) {
    std::vector<Linear> others;
    for (const Transform& instance : instances) {
        const Linear linear = linear_part(instance);
        const double squared = squared_scale(linear);
        if (squared >= 0) {
            of_similarities_ += squared * squared;
        } else {
            others.push_back(linear);
        }
    }
    std::sort(others.begin(), others.end());
    for (size_t i = 0, end = 0; i < others.size(); i = end) {
        while (end < others.size() && others[end] == others[i]) ++end;
        const Linear c = cofactors(others[i]);
        const double determinant = others[i][0] * c[0] + others[i][1] * c[1] + others[i][2] * c[2];
        stretches_.push_back({c, static_cast<double>(end - i) * determinant * determinant});
    }
}

double InstanceWeights::operator()(Vec3d n) const {
    double sum = of_similarities_;
    for (const auto& [c, weight] : stretches_) {
        const double size =
            length(Vec3d{c[0] * n.x + c[1] * n.y + c[2] * n.z, c[3] * n.x + c[4] * n.y + c[5] * n.z,
                         c[6] * n.x + c[7] * n.y + c[8] * n.z});
        if (size > 0) sum += weight / size;
    }
    return sum;
}

}  // namespace coppice
