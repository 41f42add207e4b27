#include "core/simplify/projection.h"

#include <algorithm>

namespace coppice {

namespace {

struct OnSegment {
    double along = 0;  // 0 at a, 1 at b
    double squared_distance = 0;
};

OnSegment nearest_on_segment(Vec3d p, Vec3d a, Vec3d b) {
    const Vec3d edge = b - a;
    const double squared = squared_length(edge);
    const double along = squared > 0 ? std::clamp(dot(p - a, edge) / squared, 0.0, 1.0) : 0.0;
    return {along, squared_length(p - (a + edge * along))};
}

}  // namespace

std::array<double, 3> nearest_in_triangle(Vec3d p, Vec3d a, Vec3d b, Vec3d c) {
    const Vec3d normal = cross(b - a, c - a);
    const double squared = squared_length(normal);
    if (squared > 0) {
        const double u = dot(cross(c - b, p - b), normal), v = dot(cross(a - c, p - c), normal),
                     w = dot(cross(b - a, p - a), normal);
        if (u >= 0 && v >= 0 && w >= 0) return {u / squared, v / squared, w / squared};
    }
    const OnSegment ab = nearest_on_segment(p, a, b), bc = nearest_on_segment(p, b, c),
                    ca = nearest_on_segment(p, c, a);
    if (ab.squared_distance <= bc.squared_distance && ab.squared_distance <= ca.squared_distance)
        return {1 - ab.along, ab.along, 0};
    if (bc.squared_distance <= ca.squared_distance) return {0, 1 - bc.along, bc.along};
    return {ca.along, 0, 1 - ca.along};
}

void Projection::project(uint32_t removed, uint32_t kept, const std::vector<uint32_t>& wedge_map, Vec3d at) {
    first_ = mesh_.wedge_begin(kept);
    nearest_.assign(mesh_.wedge_end(kept) - first_, Nearest{});
    for (uint32_t c = mesh_.first_corner(kept); c != no_index; c = mesh_.corner_after(c))
        look_at(c, mesh_.corner_wedge(c), at);
    const uint32_t first_removed = mesh_.wedge_begin(removed);
    for (uint32_t c = mesh_.first_corner(removed); c != no_index; c = mesh_.corner_after(c)) {
        const bool seen = mesh_.corner_vertex(CollapseMesh::next_corner(c)) == kept ||
                          mesh_.corner_vertex(CollapseMesh::previous_corner(c)) == kept;
        if (!seen) look_at(c, wedge_map[mesh_.corner_wedge(c) - first_removed], at);
    }
}

void Projection::look_at(uint32_t corner, uint32_t wedge, Vec3d at) {
    if (wedge == no_index) return;
    const uint32_t corners[] = {corner, CollapseMesh::next_corner(corner),
                                CollapseMesh::previous_corner(corner)};
    const Vec3d a = mesh_.position(mesh_.corner_vertex(corners[0])),
                b = mesh_.position(mesh_.corner_vertex(corners[1])),
                c = mesh_.position(mesh_.corner_vertex(corners[2]));
    const std::array<double, 3> weights = nearest_in_triangle(at, a, b, c);
    const double squared = squared_length(at - (a * weights[0] + b * weights[1] + c * weights[2]));
    Nearest& nearest = nearest_[wedge - first_];
    if (nearest.found && nearest.squared_distance <= squared) return;
    nearest.found = true;
    nearest.squared_distance = squared;
    for (uint32_t k = 0; k < 3; ++k) nearest.shares[k] = {mesh_.corner_wedge(corners[k]), weights[k]};
}

}  // namespace coppice
