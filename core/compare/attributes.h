// Interpolated attributes of a surface.
#pragma once

#include <array>
#include <optional>

#include "core/compare/surface.h"

namespace coppice {

// All are only defined where Surface::has says so.
inline Vec3d normal_at(const Surface& surface, size_t triangle, const std::array<double, 3>& weights) {
    Vec3d sum;
    for (size_t c = 0; c < 3; ++c)
        sum = sum + to_double(surface.normals[surface.wedges[3 * triangle + c]]) * weights[c];
    return normalized(sum);
}

template <size_t n>
std::array<double, n> value_at(const Surface& surface, const std::vector<std::array<float, n>>& values,
                               size_t triangle, const std::array<double, 3>& weights) {
    std::array<double, n> sum{};
    for (size_t c = 0; c < 3; ++c) {
        const auto& value = values[surface.wedges[3 * triangle + c]];
        for (size_t i = 0; i < n; ++i) sum[i] += weights[c] * double{value[i]};
    }
    return sum;
}

template <size_t n>
double difference(const std::array<double, n>& a, const std::array<double, n>& b) {
    double sum = 0;
    for (size_t i = 0; i < n; ++i) sum += (a[i] - b[i]) * (a[i] - b[i]);
    return std::sqrt(sum);
}

// Twice the signed area of a triangle in the texture.
inline double texture_area(const Surface& surface, size_t triangle) {
    const auto& a = surface.texture[surface.wedges[3 * triangle]];
    const auto& b = surface.texture[surface.wedges[3 * triangle + 1]];
    const auto& c = surface.texture[surface.wedges[3 * triangle + 2]];
    return (double{b[0]} - a[0]) * (double{c[1]} - a[1]) - (double{b[1]} - a[1]) * (double{c[0]} - a[0]);
}

// Degrees; none where one of them has no direction. Accurate for small angles too.
inline std::optional<double> angle_between(Vec3d a, Vec3d b) {
    if (!(squared_length(a) > 0) || !(squared_length(b) > 0)) return {};
    constexpr double degrees = 57.29577951308232;
    const Vec3d u = normalized(a), v = normalized(b);
    return std::atan2(length(cross(u, v)), dot(u, v)) * degrees;
}

}  // namespace coppice
