// How a mesh's instances stretch distances, on average over all of them.
#pragma once

#include <array>
#include <span>

#include "core/mesh/vec.h"
#include "core/scene/transform.h"

namespace coppice {

// A displacement d of the mesh becomes L d in an instance with linear part L, and its squared length d' G d
// with G = L' L. G is a sum over the instances, so their mean is one matrix, however many there are: that of
// a mean instance S with S' S = mean of G, here scaled to keep volumes. Where all instances are similarities
// it is the identity, exactly: they never change the order of collapses.
class InstanceMetric {
  public:
    explicit InstanceMetric(std::span<const Transform> instances);

    // |S^-T n|. A plane with this unit normal and a distance d in the mesh has the distance d / shrink in the
    // mean instance, and an area a on it becomes a * shrink. 1 where nothing is stretched.
    double shrink(Vec3d unit_normal) const;

    // G d: its dot product with any e is that of S d and S e. d itself where nothing is stretched.
    Vec3d dual(Vec3d d) const;

  private:
    bool is_identity_ = true;
    std::array<double, 6> metric_ = {1, 1, 1, 0, 0, 0};   // G at determinant 1: xx yy zz xy yz zx
    std::array<double, 6> inverse_ = {1, 1, 1, 0, 0, 0};  // of that
};

}  // namespace coppice
