#include "tests/support/surface.h"

#include <algorithm>
#include <limits>
#include <numeric>

namespace coppice::test {
namespace {

constexpr uint32_t leaf_size = 8;

double distance(Vec3d p, const Bounds& box) {
    const Vec3d outside = {std::max({box.min.x - p.x, 0.0, p.x - box.max.x}),
                           std::max({box.min.y - p.y, 0.0, p.y - box.max.y}),
                           std::max({box.min.z - p.z, 0.0, p.z - box.max.z})};
    return length(outside);
}

double along(Vec3d v, int axis) {
    return axis == 0 ? v.x : axis == 1 ? v.y : v.z;
}

}  // namespace

double distance(Vec3d point, const Segment& segment) {
    const Vec3d d = segment.b - segment.a;
    const double squared = squared_length(d);
    const double t = squared > 0 ? std::clamp(dot(point - segment.a, d) / squared, 0.0, 1.0) : 0;
    return length(point - (segment.a + d * t));
}

double distance(Vec3d point, Vec3d a, Vec3d b, Vec3d c) {
    const Vec3d normal = cross(b - a, c - a);
    const double squared = squared_length(normal);
    const auto inside = [&](Vec3d from, Vec3d to) {
        return dot(cross(to - from, point - from), normal) >= 0;
    };
    if (squared > 0 && inside(a, b) && inside(b, c) && inside(c, a))
        return std::abs(dot(point - a, normal)) / std::sqrt(squared);
    return std::min(
        {distance(point, Segment{a, b}), distance(point, Segment{b, c}), distance(point, Segment{c, a})});
}

Surface::Surface(const Mesh& mesh) {
    for (size_t t = 0; t < mesh.triangle_count(); ++t)
        triangles_.push_back(
            {mesh.corner_position(t, 0), mesh.corner_position(t, 1), mesh.corner_position(t, 2)});
    build();
}

Surface::Surface(const std::vector<Segment>& segments) {
    for (const Segment& segment : segments) triangles_.push_back({segment.a, segment.b, segment.b});
    build();
}

void Surface::build() {
    if (triangles_.empty()) return;
    order_.resize(triangles_.size());
    std::iota(order_.begin(), order_.end(), 0U);
    boxes_.push_back({.begin = 0, .end = static_cast<uint32_t>(order_.size())});
    for (uint32_t i = 0; i < boxes_.size(); ++i) {  // grows while it runs
        Box box = boxes_[i];
        for (uint32_t k = box.begin; k < box.end; ++k) {
            const Triangle& t = triangles_[order_[k]];
            for (const Vec3d corner : {t.a, t.b, t.c}) box.bounds.extend(corner);
        }
        if (box.end - box.begin > leaf_size) {
            const Vec3d size = box.bounds.max - box.bounds.min;
            const int axis = size.x >= size.y && size.x >= size.z ? 0 : size.y >= size.z ? 1 : 2;
            const uint32_t middle = (box.begin + box.end) / 2;
            const auto centre = [&](uint32_t t) {
                return along(triangles_[t].a, axis) + along(triangles_[t].b, axis) +
                       along(triangles_[t].c, axis);
            };
            std::nth_element(order_.begin() + box.begin, order_.begin() + middle, order_.begin() + box.end,
                             [&](uint32_t l, uint32_t r) { return centre(l) < centre(r); });
            box.left = static_cast<uint32_t>(boxes_.size());
            boxes_.push_back({.begin = box.begin, .end = middle});
            boxes_.push_back({.begin = middle, .end = box.end});
        }
        boxes_[i] = box;
    }
}

double Surface::distance_to(Vec3d point) const {
    double best = std::numeric_limits<double>::infinity();
    if (empty()) return best;
    std::vector<uint32_t> open = {0};
    while (!open.empty()) {
        const Box& box = boxes_[open.back()];
        open.pop_back();
        if (distance(point, box.bounds) >= best) continue;
        if (box.left == 0) {
            for (uint32_t k = box.begin; k < box.end; ++k) {
                const Triangle& t = triangles_[order_[k]];
                best = std::min(best, distance(point, t.a, t.b, t.c));
            }
            continue;
        }
        // The nearer child is looked at first.
        const bool left_first =
            distance(point, boxes_[box.left].bounds) <= distance(point, boxes_[box.left + 1].bounds);
        open.push_back(left_first ? box.left + 1 : box.left);
        open.push_back(left_first ? box.left : box.left + 1);
    }
    return best;
}

std::vector<uint32_t> Surface::within(Vec3d point, double radius) const {
    std::vector<uint32_t> found;
    if (empty()) return found;
    std::vector<uint32_t> open = {0};
    while (!open.empty()) {
        const Box& box = boxes_[open.back()];
        open.pop_back();
        if (distance(point, box.bounds) > radius) continue;
        if (box.left != 0) {
            open.push_back(box.left);
            open.push_back(box.left + 1);
            continue;
        }
        for (uint32_t k = box.begin; k < box.end; ++k) {
            const Triangle& t = triangles_[order_[k]];
            if (distance(point, t.a, t.b, t.c) <= radius) found.push_back(order_[k]);
        }
    }
    return found;
}

}  // namespace coppice::test
