#include "core/format/triangulate.h"

#include <cassert>
#include <cmath>

namespace coppice {

namespace {

constexpr uint64_t tests_per_corner = 4000;

struct Point {
    double x = 0, y = 0;

    friend bool operator==(const Point&, const Point&) = default;
};

// Twice the signed area; positive when a, b, c turn left.
double turn(Point a, Point b, Point c) {
    return (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
}

// Twice the area vector (Newell), right for concave and slightly bent polygons.
Vec3d newell_normal(std::span<const Vec3d> corners) {
    Vec3d normal;
    for (size_t i = 0; i < corners.size(); ++i) {
        // Relative to the first corner, so that a polygon far from the origin loses no digits.
        const Vec3d a = corners[i] - corners[0], b = corners[(i + 1) % corners.size()] - corners[0];
        normal = normal + cross(a, b);
    }
    return normal;
}

// Drops the axis that the normal is longest in, such that the polygon turns left.
std::vector<Point> flattened(std::span<const Vec3d> corners, Vec3d normal) {
    const double x = std::abs(normal.x), y = std::abs(normal.y), z = std::abs(normal.z);
    std::vector<Point> points;
    points.reserve(corners.size());
    for (const Vec3d& c : corners) {
        if (x >= y && x >= z) {
            points.push_back(normal.x > 0 ? Point{c.y, c.z} : Point{c.z, c.y});
        } else if (y >= z) {
            points.push_back(normal.y > 0 ? Point{c.z, c.x} : Point{c.x, c.z});
        } else {
            points.push_back(normal.z > 0 ? Point{c.x, c.y} : Point{c.y, c.x});
        }
    }
    return points;
}

void split_quad(std::span<const Vec3d> q, std::vector<uint32_t>& triangles) {
    const Vec3d normal = newell_normal(q);
    // How much the smaller half of each diagonal's split faces along the quad; negative: the diagonal lies
    // outside.
    const auto facing = [&](size_t a, size_t b, size_t c) {
        return dot(cross(q[b] - q[a], q[c] - q[a]), normal);
    };
    const bool inner02 = facing(0, 1, 2) > 0 && facing(0, 2, 3) > 0;
    const bool inner13 = facing(1, 2, 3) > 0 && facing(1, 3, 0) > 0;
    const bool shorter13 = squared_length(q[1] - q[3]) < squared_length(q[0] - q[2]);
    const bool take13 = inner02 == inner13 ? shorter13 : inner13;
    if (take13) {
        triangles.insert(triangles.end(), {0, 1, 3, 1, 2, 3});
    } else {
        triangles.insert(triangles.end(), {0, 1, 2, 0, 2, 3});
    }
}

// The corners that are left, as a ring.
class EarClipper {
  public:
    EarClipper(std::vector<Point> points, std::vector<uint32_t>& triangles)
        : points_(std::move(points)), triangles_(triangles), tests_left_(tests_per_corner * points_.size()) {
        const auto n = static_cast<uint32_t>(points_.size());
        for (uint32_t i = 0; i < n; ++i) {
            next_.push_back((i + 1) % n);
            previous_.push_back((i + n - 1) % n);
        }
        left_ = n;
    }

    void clip_all() {
        while (left_ > 3 && clip_round(Wanted::ear)) {
        }
        // What has no proper ear crosses or touches itself: flat corners first, then anything convex, then a
        // fan.
        while (left_ > 3 && (clip_round(Wanted::flat) || clip_round(Wanted::convex))) {
        }
        while (left_ >= 3) clip(next_[at_]);
    }

  private:
    enum class Wanted { ear, flat, convex };

    // Goes round once, or until something was clipped. Skipping a corner after each ear spreads the
    // triangles.
    bool clip_round(Wanted wanted) {
        for (size_t steps = left_; steps > 0; --steps) {
            if (tests_left_ == 0) return false;
            --tests_left_;
            if (is_wanted(at_, wanted)) {
                const uint32_t after = next_[at_];
                clip(at_);
                at_ = next_[after];
                return true;
            }
            at_ = next_[at_];
        }
        return false;
    }

    bool is_wanted(uint32_t corner, Wanted wanted) {
        const double area = turn(points_[previous_[corner]], points_[corner], points_[next_[corner]]);
        if (wanted == Wanted::flat) return area == 0;
        return area > 0 && (wanted == Wanted::convex || is_empty(corner));
    }

    // No other corner in the triangle or on its border; corners at the same place as one of its own do not
    // count, as the bridges of a keyhole polygon lie there.
    bool is_empty(uint32_t corner) {
        const Point a = points_[previous_[corner]], b = points_[corner], c = points_[next_[corner]];
        for (uint32_t i = next_[next_[corner]]; i != previous_[corner]; i = next_[i]) {
            if (tests_left_ == 0) return true;
            --tests_left_;
            const Point p = points_[i];
            if (turn(a, b, p) < 0 || turn(b, c, p) < 0 || turn(c, a, p) < 0) continue;
            if (p == a || p == b || p == c) continue;
            return false;
        }
        return true;
    }

    void clip(uint32_t corner) {
        triangles_.insert(triangles_.end(), {previous_[corner], corner, next_[corner]});
        next_[previous_[corner]] = next_[corner];
        previous_[next_[corner]] = previous_[corner];
        if (at_ == corner) at_ = next_[corner];
        --left_;
    }

    std::vector<Point> points_;
    std::vector<uint32_t>& triangles_;
    std::vector<uint32_t> next_, previous_;
    size_t left_ = 0;
    uint32_t at_ = 0;
    uint64_t tests_left_;
};

}  // namespace

void triangulate(std::span<const Vec3d> corners, std::vector<uint32_t>& triangles) {
    assert(corners.size() >= 3);
    if (corners.size() == 3) {
        triangles.insert(triangles.end(), {0, 1, 2});
        return;
    }
    if (corners.size() == 4) return split_quad(corners, triangles);
    EarClipper(flattened(corners, newell_normal(corners)), triangles).clip_all();
}

}  // namespace coppice
