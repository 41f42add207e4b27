#include "core/simplify/line_guard.h"

#include <algorithm>

#include "core/base/watched_loop.h"

namespace coppice {

namespace {

double distance_to_segment(Vec3d point, Vec3d a, Vec3d b) {
    const Vec3d d = b - a;
    const double squared = squared_length(d);
    const double t = squared > 0 ? std::clamp(dot(point - a, d) / squared, 0.0, 1.0) : 0;
    return length(point - (a + d * t));
}

}  // namespace

LineGuard::LineGuard(const CollapseMesh& mesh, const Features& features, double tolerance, const Watch& watch)
    : mesh_(mesh),
      tolerance_(tolerance),
      on_line_(mesh.vertex_count()),
      next_(watched_vector<Both>(mesh.vertex_count(), watch)) {
    watched_loop(mesh.vertex_count(), watch, [&](size_t v) {
        on_line_[v] = features.kinds[v] == VertexKind::border || features.kinds[v] == VertexKind::seam;
    });
    const auto add = [&](uint32_t from, uint32_t to) {
        Both& both = next_[from];
        if (both[0].vertex == to || both[1].vertex == to) return;  // a seam is listed once per side
        (both[0].vertex == no_index ? both[0] : both[1]).vertex = to;
    };
    watched_loop(features.edges.size(), watch, [&](size_t i) {
        const FeatureEdge& edge = features.edges[i];
        if (on_line_[edge.a]) add(edge.a, edge.b);
        if (on_line_[edge.b]) add(edge.b, edge.a);
    });
}

std::optional<LineGuard::Both> LineGuard::along(uint32_t removed, uint32_t kept) const {
    Both both = next_[removed];
    if (both[1].vertex == kept) std::swap(both[0], both[1]);
    if (both[0].vertex != kept || both[1].vertex == no_index) return {};
    return both;
}

// Each point of the two old edges is that near to the new one, and the other way round; what they were away
// themselves comes on top.
double LineGuard::away_without(uint32_t removed, const Both& ends) const {
    return std::max(ends[0].away, ends[1].away) + distance_to_segment(mesh_.position(removed),
                                                                      mesh_.position(ends[0].vertex),
                                                                      mesh_.position(ends[1].vertex));
}

bool LineGuard::may_remove(uint32_t removed, uint32_t kept) const {
    if (!on_line_[removed]) return true;
    const auto ends = along(removed, kept);
    return ends && away_without(removed, *ends) <= tolerance_;
}

void LineGuard::remove(uint32_t removed, uint32_t kept) {
    if (!on_line_[removed]) return;
    const auto ends = along(removed, kept);
    if (!ends) return;
    const double away = away_without(removed, *ends);
    const uint32_t other = (*ends)[1].vertex;
    relink(kept, removed, {other, away});
    relink(other, removed, {kept, away});
}

void LineGuard::relink(uint32_t vertex, uint32_t from, Next to) {
    if (!on_line_[vertex]) return;
    for (Next& next : next_[vertex])
        if (next.vertex == from) next = to;
}

}  // namespace coppice
