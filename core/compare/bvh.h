// A tree of boxes over triangles: exact nearest points, what is within a radius, whose boxes meet.
//
// Flat arrays; split by the surface area heuristic over bins (Wald 2007), at most 4 triangles in a leaf.
// Depth is bounded whatever the geometry, so that the walks need no recursion and a stack of known size. The
// same tree for any number of threads. O(n log n) to build, about 25 bytes a triangle. Immutable afterwards;
// any number of threads may ask.
#pragma once

#include <array>
#include <cmath>
#include <limits>

#include "core/compare/closest_point.h"
#include "core/compare/surface.h"

namespace coppice {

class Bvh {
  public:
    static constexpr uint32_t none = std::numeric_limits<uint32_t>::max();

    struct Nearest {
        uint32_t triangle = none;
        TrianglePoint point = {};  // of that triangle

        double distance() const { return std::sqrt(point.squared_distance); }
    };

    // Reorders the triangles of the surface, so that those of a leaf are beside each other. Keeps a reference
    // to it.
    Bvh(Surface& surface, unsigned threads, const Watch& watch);

    const Surface& surface() const { return surface_; }

    // The nearest point of the surface, which must have a triangle; the first of those that are equally near.
    // hint: a triangle that is near, to be faster. The distance does not depend on it.
    Nearest nearest(Vec3d p, uint32_t hint = none) const;

    // visit(triangle, TrianglePoint) for the nearest point of each triangle that is no farther than that.
    template <typename Visit>
    void visit_within(Vec3d p, double squared_radius, Visit visit) const;

    // visit(other) for each triangle `other` after this one whose box meets this one's. Boxes are rounded
    // outwards to floats.
    template <typename Visit>
    void visit_meeting(uint32_t triangle, Visit visit) const;

  private:
    struct Box {
        std::array<float, 3> min, max;

        void extend(const Box& other);
        double half_area() const;
        double squared_distance(Vec3d p) const;
        bool meets(const Box& other) const;
    };
    struct Node {
        Box box;
        uint32_t begin = 0;  // a leaf: its first triangle; else its first child, beside which the other is
        uint32_t count = 0;  // a leaf: how many triangles; else 0
    };
    struct Range {
        uint32_t node = 0, begin = 0, end = 0, depth = 0;
    };
    class Builder;

    // Halves range from that depth on, where bins have not: so none is deeper than 40 + 32.
    static constexpr uint32_t deepest_bins = 40;
    using Stack = std::array<uint32_t, deepest_bins + 34>;

    static Box box_of(const std::array<Vec3d, 3>& corners);

    const Surface& surface_;
    std::vector<Node> nodes_;  // none where there is no triangle
};

inline double Bvh::Box::squared_distance(Vec3d p) const {
    const auto outside = [](double at, double low, double high) {
        return at < low ? low - at : (at > high ? at - high : 0.0);
    };
    const double x = outside(p.x, min[0], max[0]), y = outside(p.y, min[1], max[1]),
                 z = outside(p.z, min[2], max[2]);
    return x * x + y * y + z * z;
}

inline bool Bvh::Box::meets(const Box& other) const {
    return min[0] <= other.max[0] && other.min[0] <= max[0] && min[1] <= other.max[1] &&
           other.min[1] <= max[1] && min[2] <= other.max[2] && other.min[2] <= max[2];
}

template <typename Visit>
void Bvh::visit_within(Vec3d p, double squared_radius, Visit visit) const {
    Stack stack;
    size_t size = 0;
    if (!nodes_.empty()) stack[size++] = 0;
    while (size > 0) {
        const Node& node = nodes_[stack[--size]];
        if (node.box.squared_distance(p) > squared_radius) continue;
        if (node.count == 0) {
            stack[size++] = node.begin + 1;
            stack[size++] = node.begin;
            continue;
        }
        for (uint32_t t = node.begin; t < node.begin + node.count; ++t) {
            const auto [a, b, c] = surface_.corners(t);
            const TrianglePoint point = closest_point(p, a, b, c);
            if (point.squared_distance <= squared_radius) visit(t, point);
        }
    }
}

template <typename Visit>
void Bvh::visit_meeting(uint32_t triangle, Visit visit) const {
    const Box box = box_of(surface_.corners(triangle));
    Stack stack;
    size_t size = 0;
    if (!nodes_.empty()) stack[size++] = 0;
    while (size > 0) {
        const Node& node = nodes_[stack[--size]];
        if (!node.box.meets(box)) continue;
        if (node.count == 0) {
            stack[size++] = node.begin + 1;
            stack[size++] = node.begin;
            continue;
        }
        for (uint32_t t = std::max(node.begin, triangle + 1); t < node.begin + node.count; ++t) {
            if (box_of(surface_.corners(t)).meets(box)) visit(t);
        }
    }
}

}  // namespace coppice
