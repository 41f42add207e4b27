// By how much more a mesh's planes weigh for all the instances that show it.
#pragma once

#include <array>
#include <span>
#include <vector>

#include "core/mesh/vec.h"
#include "core/scene/transform.h"

namespace coppice {

// In an instance with linear part L, a triangle of area A and unit normal n has the area A |det L| |L^-T n|,
// and a distance d to its plane becomes d / |L^-T n|. So the sum over all instances of area times squared
// distance is that in the mesh, A d^2, times
//
//     sum over instances |det L| / |L^-T n|
//
// which is s^4 for each similarity of scale s. No plane is ever transformed, and similarities cost one number
// together.
class InstanceWeights {
  public:
    explicit InstanceWeights(std::span<const Transform> instances);

    double operator()(Vec3d unit_normal) const;

  private:
    // |det L| / |L^-T n| = det^2 / |cofactors n|, for `count` instances that stretch alike.
    struct Stretch {
        std::array<double, 9> cofactors = {};  // row-major
        double weight = 0;                     // count * det^2
    };

    double of_similarities_ = 0;
    std::vector<Stretch> stretches_;
};

}  // namespace coppice
