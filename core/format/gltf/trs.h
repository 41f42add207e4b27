// Translation, rotation and scale of a transform, for where glTF wants them apart.
#pragma once

#include <array>
#include <optional>
#include <utility>

#include "core/scene/transform.h"

namespace coppice::gltf {

struct Trs {
    Vec3d translation = {};
    std::array<double, 4> rotation = {0, 0, 0, 1};  // x y z w, unit length, w >= 0
    Vec3d scale = {1, 1, 1};
};

// None where the transform shears or is singular. Mirrored ones get a negative scale along x.
std::optional<Trs> decompose(const Transform& transform);

// outer * inner is the transform, each without shear (singular value decomposition); none where it is
// singular.
std::optional<std::pair<Trs, Trs>> decompose_in_two(const Transform& transform);

// Whether Khronos' validator takes a node's matrix: last row, not singular, and close to its own
// decomposition.
bool is_valid_node_matrix(const std::array<double, 16>& column_major);

}  // namespace coppice::gltf
