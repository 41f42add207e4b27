#include "core/simplify/target.h"

#include <algorithm>

#include "core/mesh/weld.h"

namespace coppice {

namespace {

double way(uint32_t first, uint32_t now, std::optional<uint64_t> target) {
    if (!target || *target >= first) return target ? 1.0 : 0.0;
    return static_cast<double>(first - now) / static_cast<double>(first - *target);
}

}  // namespace

bool is_small_enough(const Mesh& mesh, const Target& target) {
    if (mesh.triangle_count() == 0) return true;
    if (target.triangles && mesh.triangle_count() <= *target.triangles) return true;
    return target.vertices && mesh.vertex_count() <= *target.vertices;
}

double triangles_when_met(const Target& target, const CollapseMesh& mesh) {
    const double now = mesh.live_triangles();
    double most = 0;
    if (target.triangles) most = static_cast<double>(*target.triangles);
    if (target.vertices)
        most = std::max(most, now - 2 * (mesh.live_vertices() - static_cast<double>(*target.vertices)));
    return std::min(most, now);
}

Simplified already_smaller(const Mesh& mesh, const Watch& watch) {
    Simplified same = {.mesh = mesh, .stop_reason = StopReason::already_smaller};
    drop_unused(same.mesh, watch);
    return same;
}

bool TargetCount::is_met(const CollapseMesh& mesh) const {
    if (target_.triangles && mesh.live_triangles() <= *target_.triangles) return true;
    return target_.vertices && mesh.live_vertices() <= *target_.vertices;
}

double TargetCount::fraction(const CollapseMesh& mesh) const {
    const double by_triangles = way(triangles_, mesh.live_triangles(), target_.triangles);
    const double by_vertices = way(vertices_, mesh.live_vertices(), target_.vertices);
    const double by_removal = triangles_ > 0 ? way(triangles_, mesh.live_triangles(), 0) : 1.0;
    return std::clamp(std::max({by_triangles, by_vertices, by_removal}), 0.0, 1.0);
}

}  // namespace coppice
