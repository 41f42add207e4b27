#include "core/mesh/bounds.h"

#include <algorithm>

namespace coppice {

void Bounds::extend(Vec3d point) {
    min = {std::min(min.x, point.x), std::min(min.y, point.y), std::min(min.z, point.z)};
    max = {std::max(max.x, point.x), std::max(max.y, point.y), std::max(max.z, point.z)};
}

void Bounds::extend(const Bounds& other) {
    if (other.empty()) return;
    extend(other.min);
    extend(other.max);
}

Bounds bounds(std::span<const Vec3f> positions) {
    Bounds box;
    for (const Vec3f& position : positions) box.extend(to_double(position));
    return box;
}

}  // namespace coppice
