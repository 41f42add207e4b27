#include "core/compare/closest_point.h"

#include <algorithm>

namespace coppice {

namespace {

// How far along a to b the nearest point of that segment is, 0..1.
double along(Vec3d p, Vec3d a, Vec3d b) {
    const Vec3d ab = b - a;
    const double squared = squared_length(ab);
    return squared > 0 ? std::clamp(dot(p - a, ab) / squared, 0.0, 1.0) : 0.0;
}

TrianglePoint at(Vec3d p, Vec3d a, Vec3d b, Vec3d c, std::array<double, 3> weights) {
    return {weights, squared_length(p - interpolate(weights, a, b, c))};
}

TrianglePoint closest_on_edges(Vec3d p, Vec3d a, Vec3d b, Vec3d c) {
    const double ab = along(p, a, b), bc = along(p, b, c), ca = along(p, c, a);
    TrianglePoint best = at(p, a, b, c, {1 - ab, ab, 0});
    for (const auto& weights : {std::array{0.0, 1 - bc, bc}, std::array{ca, 0.0, 1 - ca}}) {
        const TrianglePoint other = at(p, a, b, c, weights);
        if (other.squared_distance < best.squared_distance) best = other;
    }
    return best;
}

}  // namespace

TrianglePoint closest_point(Vec3d p, Vec3d a, Vec3d b, Vec3d c) {
    const Vec3d ab = b - a, ac = c - a, ap = p - a;
    const double d1 = dot(ab, ap), d2 = dot(ac, ap);
    if (d1 <= 0 && d2 <= 0) return {{1, 0, 0}, squared_length(ap)};

    const Vec3d bp = p - b;
    const double d3 = dot(ab, bp), d4 = dot(ac, bp);
    if (d3 >= 0 && d4 <= d3) return {{0, 1, 0}, squared_length(bp)};

    const Vec3d cp = p - c;
    const double d5 = dot(ab, cp), d6 = dot(ac, cp);
    if (d6 >= 0 && d5 <= d6) return {{0, 0, 1}, squared_length(cp)};

    // Twice the areas that p's projection makes with the edges, times that of the triangle. Where all of them
    // are noise, the edges are all there is.
    const double va = d3 * d6 - d5 * d4, vb = d5 * d2 - d1 * d6, vc = d1 * d4 - d3 * d2;
    const double squared_area = squared_length(cross(ab, ac));
    constexpr double flat = 1e-20;  // sine of the angle below 1e-10
    if (squared_area <= flat * squared_length(ab) * squared_length(ac)) return closest_on_edges(p, a, b, c);

    if (vc <= 0 && d1 >= 0 && d3 <= 0) {
        const double v = d1 / (d1 - d3);
        return at(p, a, b, c, {1 - v, v, 0});
    }
    if (vb <= 0 && d2 >= 0 && d6 <= 0) {
        const double w = d2 / (d2 - d6);
        return at(p, a, b, c, {1 - w, 0, w});
    }
    if (va <= 0 && d4 - d3 >= 0 && d5 - d6 >= 0) {
        const double w = (d4 - d3) / ((d4 - d3) + (d5 - d6));
        return at(p, a, b, c, {0, 1 - w, w});
    }
    const double sum = va + vb + vc;
    if (!(va >= 0 && vb >= 0 && vc >= 0 && sum > 0)) return closest_on_edges(p, a, b, c);
    return at(p, a, b, c, {va / sum, vb / sum, vc / sum});
}

}  // namespace coppice
