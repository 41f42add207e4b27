#include "core/simplify/deviation.h"

#include <algorithm>

namespace coppice {

std::optional<double> distance_from_above(Vec3d p, Vec3d a, Vec3d b, Vec3d c) {
    const Vec3d normal = cross(b - a, c - a);
    const double size = length(normal);
    const bool inside = size > 0 && dot(cross(b - a, p - a), normal) >= 0 &&
                        dot(cross(c - b, p - b), normal) >= 0 && dot(cross(a - c, p - c), normal) >= 0;
    return inside ? std::optional(std::abs(dot(p - a, normal)) / size) : std::nullopt;
}

double distance_to_triangle(Vec3d p, Vec3d a, Vec3d b, Vec3d c) {
    if (const auto distance = distance_from_above(p, a, b, c)) return *distance;
    return std::min(
        {distance_to_segment(p, a, b), distance_to_segment(p, b, c), distance_to_segment(p, c, a)});
}

double Deviation::after(uint32_t removed, uint32_t kept) const {
    const Vec3d from = mesh_.position(removed), to = mesh_.position(kept);
    double distance = length(from - to);
    for (uint32_t c = mesh_.first_corner(removed); c != no_index; c = mesh_.corner_after(c)) {
        const uint32_t a = mesh_.corner_vertex(CollapseMesh::next_corner(c));
        const uint32_t b = mesh_.corner_vertex(CollapseMesh::previous_corner(c));
        if (a == kept || b == kept) continue;
        distance = std::min(distance, distance_to_triangle(from, to, mesh_.position(a), mesh_.position(b)));
    }
    return std::max(carried_[kept], carried_[removed] + distance);
}

void Deviation::merge(uint32_t kept, double deviation) {
    carried_[kept] = deviation;
    largest_ = std::max(largest_, deviation);
}

}  // namespace coppice
