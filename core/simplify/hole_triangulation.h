// The hole that a removed vertex leaves, filled with triangles of the vertices around it.
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "core/mesh/vec.h"

namespace coppice {

enum class Stitch : uint8_t {
    delaunay,  // the best shaped ear first, on the plane that fits the ring
    zigzag,    // a strip from the ring's largest vertex: Li and Kim 2019, figure 3, in the plane
    paper,     // the same paper's rule in space, by sorted vertices: it overlaps, and gives one too many
};

class HoleTriangulation {
  public:
    using Triangle = std::array<uint32_t, 3>;  // places in the ring, wound as it is
    // Whether the edge between two places that are not neighbours may be made.
    using MayJoin = std::function<bool(uint32_t, uint32_t)>;

    // Fills a ring of three or more points, which goes counter-clockwise around what it looks like from
    // outside. False where it cannot be filled without folds or forbidden edges. Gives two triangles less
    // than points; `paper` one less, and asks nothing. O(n^2).
    bool fill(std::span<const Vec3d> ring, Stitch stitch, const MayJoin& may_join);

    std::span<const Triangle> triangles() const { return triangles_; }

  private:
    struct Point {
        double x, y;
    };
    static double turn(Point a, Point b, Point c) {
        return (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
    }

    bool clip_ears(const MayJoin& may_join);
    bool zigzag(const MayJoin& may_join);
    void stitch_sorted();
    bool project();
    bool crosses_itself() const;
    double shape_of_ear(uint32_t place) const;

    std::span<const Vec3d> ring_;
    std::vector<Triangle> triangles_;
    std::vector<Point> plane_;             // the ring, seen from where it faces
    std::vector<uint32_t> next_, before_;  // of the places that are left
    std::vector<double> shapes_;           // of the ear at each place; negative: none
    bool convex_ = true;
};

}  // namespace coppice
