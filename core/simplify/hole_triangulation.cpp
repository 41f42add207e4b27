#include "core/simplify/hole_triangulation.h"

#include <algorithm>
#include <cassert>
#include <numeric>
#include <tuple>

namespace coppice {

namespace {

// Newell's: its length is twice the area of the ring's shadow on the plane that it stands on.
Vec3d newell_normal(std::span<const Vec3d> ring) {
    Vec3d sum;
    for (size_t i = 1; i + 1 < ring.size(); ++i) sum = sum + cross(ring[i] - ring[0], ring[i + 1] - ring[0]);
    return sum;
}

bool is_greater(Vec3d a, Vec3d b) {
    return std::tie(a.x, a.y, a.z) > std::tie(b.x, b.y, b.z);
}

}  // namespace

bool HoleTriangulation::fill(std::span<const Vec3d> ring, Stitch stitch, const MayJoin& may_join) {
    assert(ring.size() >= 3);
    ring_ = ring;
    triangles_.clear();
    if (stitch == Stitch::paper) {
        stitch_sorted();
        return true;
    }
    if (ring.size() == 3) {
        triangles_.push_back({0, 1, 2});
        return true;
    }
    return stitch == Stitch::zigzag ? zigzag(may_join) : clip_ears(may_join);
}

bool HoleTriangulation::project() {
    const Vec3d normal = newell_normal(ring_);
    const double size = length(normal);
    if (!(size > 0)) return false;
    const Vec3d up = normal * (1 / size);
    // Any axis across the normal will do.
    const Vec3d axis = std::abs(up.x) < 0.6 ? Vec3d{1, 0, 0} : Vec3d{0, 1, 0};
    const Vec3d right = normalized(cross(axis, up)), ahead = cross(up, right);
    plane_.clear();
    for (const Vec3d p : ring_) plane_.push_back({dot(p - ring_[0], right), dot(p - ring_[0], ahead)});
    const size_t count = plane_.size();
    convex_ = true;
    for (size_t i = 0; i < count; ++i)
        convex_ &= turn(plane_[i], plane_[(i + 1) % count], plane_[(i + 2) % count]) > 0;
    return convex_ || !crosses_itself();
}

bool HoleTriangulation::crosses_itself() const {
    const size_t count = plane_.size();
    for (size_t i = 0; i < count; ++i) {
        const Point a = plane_[i], b = plane_[(i + 1) % count];
        for (size_t j = i + 2; j < count && (j + 1) % count != i; ++j) {
            const Point c = plane_[j], d = plane_[(j + 1) % count];
            if (turn(a, b, c) * turn(a, b, d) <= 0 && turn(c, d, a) * turn(c, d, b) <= 0) return true;
        }
    }
    return false;
}

// Area to the squares of the edges; negative where the ring turns the other way or another vertex is inside.
double HoleTriangulation::shape_of_ear(uint32_t place) const {
    const Point a = plane_[before_[place]], b = plane_[place], c = plane_[next_[place]];
    const double area = turn(a, b, c);
    if (!(area > 0)) return -1;
    for (uint32_t i = next_[next_[place]]; !convex_ && i != before_[place]; i = next_[i]) {
        const Point p = plane_[i];
        if (turn(a, b, p) >= 0 && turn(b, c, p) >= 0 && turn(c, a, p) >= 0) return -1;
    }
    const auto squared = [](Point p, Point q) {
        return (p.x - q.x) * (p.x - q.x) + (p.y - q.y) * (p.y - q.y);
    };
    return area / (squared(a, b) + squared(b, c) + squared(c, a));
}

bool HoleTriangulation::clip_ears(const MayJoin& may_join) {
    if (!project()) return false;
    const auto count = static_cast<uint32_t>(ring_.size());
    next_.resize(count), before_.resize(count), shapes_.resize(count);
    for (uint32_t i = 0; i < count; ++i) {
        next_[i] = (i + 1) % count;
        before_[i] = (i + count - 1) % count;
    }
    for (uint32_t i = 0; i < count; ++i) shapes_[i] = shape_of_ear(i);
    for (uint32_t left = count; left > 3;) {
        const auto best =
            static_cast<uint32_t>(std::max_element(shapes_.begin(), shapes_.end()) - shapes_.begin());
        if (!(shapes_[best] > 0)) return false;
        const uint32_t a = before_[best], b = next_[best];
        shapes_[best] = -1;
        if (!may_join(a, b)) continue;
        triangles_.push_back({a, best, b});
        next_[a] = b;
        before_[b] = a;
        --left;
        shapes_[a] = shape_of_ear(a);
        shapes_[b] = shape_of_ear(b);
        if (left > 3) continue;
        triangles_.push_back({before_[a], a, b});
        return shapes_[a] > 0;
    }
    return false;
}

bool HoleTriangulation::zigzag(const MayJoin& may_join) {
    const auto count = static_cast<uint32_t>(ring_.size());
    const auto first = static_cast<uint32_t>(
        std::max_element(ring_.begin(), ring_.end(), [](Vec3d a, Vec3d b) { return is_greater(b, a); }) -
        ring_.begin());
    uint32_t left = 1, right = count - 1;  // steps from there
    const auto place = [&](uint32_t step) { return (first + step) % count; };
    triangles_.push_back({place(0), place(left), place(right)});
    for (bool on_left = true; right - left > 1; on_left = !on_left) {
        if (!may_join(place(left), place(right))) return false;
        const uint32_t third = on_left ? left + 1 : right - 1;
        triangles_.push_back({place(left), place(third), place(right)});
        (on_left ? left : right) = third;
    }
    return true;
}

// (s0, si, si+1), and (s0, sn-1, s1) to close, of the ring sorted from its largest vertex on: section III.C,
// "if the ordered vertex order is v1, v3, v5, v4, v2, v6". Turned to face as the ring does.
void HoleTriangulation::stitch_sorted() {
    std::vector<uint32_t> sorted(ring_.size());
    std::iota(sorted.begin(), sorted.end(), 0U);
    std::sort(sorted.begin(), sorted.end(),
              [this](uint32_t a, uint32_t b) { return is_greater(ring_[a], ring_[b]); });
    const Vec3d facing = newell_normal(ring_);
    const auto add = [&](uint32_t a, uint32_t b, uint32_t c) {
        const bool turned = dot(cross(ring_[b] - ring_[a], ring_[c] - ring_[a]), facing) < 0;
        triangles_.push_back({a, turned ? c : b, turned ? b : c});
    };
    for (size_t i = 1; i + 1 < sorted.size(); ++i) add(sorted[0], sorted[i], sorted[i + 1]);
    add(sorted[0], sorted.back(), sorted[1]);
}

}  // namespace coppice
