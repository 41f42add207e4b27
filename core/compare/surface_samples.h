// Points on a surface, chosen once and for all: the same for any number of threads and any order of
// triangles.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "core/compare/surface.h"

namespace coppice {

struct SurfaceSample {
    uint32_t triangle = 0;
    std::array<double, 3> weights = {};  // barycentric, of its corners
};

// `count` points, one in each of as many parts of equal area that the triangles make in their order
// (stratified; where there is no area, of as many triangles). The surface must have a triangle and outlive
// this.
class AreaSamples {
  public:
    AreaSamples(const Surface& surface, uint64_t count, uint64_t seed, const Watch& watch);

    uint64_t count() const { return count_; }
    double area() const { return area_; }  // of the surface; 0 where there is none

    // visit(sample) for samples begin..end-1; O(log triangles) plus one step for each triangle passed.
    template <typename Visit>
    void visit(uint64_t begin, uint64_t end, Visit visit) const {
        for (uint32_t triangle = triangle_at(begin); begin < end; ++begin) visit(next(begin, triangle));
    }

  private:
    uint32_t triangle_at(uint64_t sample) const;
    SurfaceSample next(uint64_t sample, uint32_t& triangle) const;
    double place(uint64_t sample) const;

    uint64_t count_, seed_;
    double area_ = 0;
    std::vector<double> ends_;  // per triangle: area up to its end
};

// The same along the edges, by length; an edge of two triangles is walked twice.
class EdgeSamples {
  public:
    EdgeSamples(const Surface& surface, uint64_t count, uint64_t seed, const Watch& watch);

    uint64_t count() const { return count_; }  // 0 where no edge has a length

    // visit(position) for samples begin..end-1.
    template <typename Visit>
    void visit(uint64_t begin, uint64_t end, Visit visit) const {
        for (uint32_t triangle = triangle_at(begin); begin < end; ++begin) visit(next(begin, triangle));
    }

  private:
    uint32_t triangle_at(uint64_t sample) const;
    Vec3d next(uint64_t sample, uint32_t& triangle) const;
    double place(uint64_t sample) const;

    const Surface& surface_;
    uint64_t count_, seed_;
    std::vector<double> ends_;  // per triangle: length of its edges and all before
};

}  // namespace coppice
