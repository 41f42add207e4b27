#include "core/simplify/line_guard.h"

#include <algorithm>
#include <limits>

#include "core/base/watched_loop.h"
#include "core/simplify/deviation.h"

namespace coppice {

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

double LineGuard::turn_cosine(uint32_t vertex) const {
    if (!on_line_[vertex]) return 1;
    const auto [one, other] = next_[vertex];
    if (one.vertex == no_index || other.vertex == no_index) return -1;
    const Vec3d p = mesh_.position(vertex);
    return dot(normalized(p - mesh_.position(one.vertex)), normalized(mesh_.position(other.vertex) - p));
}

std::optional<LineGuard::Stretch> LineGuard::stretch(std::span<const uint32_t> vertices, Vec3d point) const {
    const auto holds = [&](uint32_t v) {
        return std::find(vertices.begin(), vertices.end(), v) != vertices.end();
    };
    const auto first =
        std::find_if(vertices.begin(), vertices.end(), [this](uint32_t v) { return on_line_[v]; });
    const auto count = std::count_if(first, vertices.end(), [this](uint32_t v) { return on_line_[v]; });
    if (count == 0) return {};
    Stretch found;
    double away = 0;
    std::ptrdiff_t passed = 1;
    for (const size_t side : {size_t{0}, size_t{1}}) {
        uint32_t from = no_index, at = *first;
        Next next = next_[at][side];
        for (; next.vertex != no_index && on_line_[next.vertex] && holds(next.vertex); ++passed) {
            if (passed == count) return {};  // all around
            from = at, at = next.vertex;
            away = std::max(away, next.away);
            next = next_[at][next_[at][0].vertex == from ? 1 : 0];
        }
        if (next.vertex == no_index) return {};
        away = std::max(away, next.away);
        found.outermost[side] = at;
        if (!holds(next.vertex)) found.beyond[side] = next;
    }
    if (passed != count || found.beyond[0].vertex == found.beyond[1].vertex) return {};
    double farthest = 0;
    for (const uint32_t v : vertices) {
        if (!on_line_[v]) continue;
        double near = std::numeric_limits<double>::infinity();
        for (const Next& end : found.beyond) {
            if (end.vertex == no_index) continue;
            near = std::min(near, distance_to_segment(mesh_.position(v), point, mesh_.position(end.vertex)));
        }
        farthest = std::max(farthest, near);
    }
    found.away = away + farthest;
    return found;
}

bool LineGuard::may_merge(std::span<const uint32_t> vertices, Vec3d point) const {
    const auto found = stretch(vertices, point);
    return found && found->away <= tolerance_;
}

void LineGuard::merge(std::span<const uint32_t> vertices, uint32_t kept, Vec3d point) {
    const auto found = stretch(vertices, point);
    if (!found) return;
    for (const size_t side : {size_t{0}, size_t{1}}) {
        const uint32_t beyond = found->beyond[side].vertex;
        if (beyond != no_index) relink(beyond, found->outermost[side], {kept, found->away});
    }
    for (const size_t side : {size_t{0}, size_t{1}})
        next_[kept][side] = {found->beyond[side].vertex, found->away};
}

// A new edge is at most as far from the old one as the end that has moved.
double LineGuard::away_joined(std::span<const uint32_t> vertices, Vec3d point) const {
    double away = 0;
    for (const uint32_t v : vertices) {
        const double moved = on_line_[v] ? length(mesh_.position(v) - point) : 0;
        for (const Next& next : next_[v]) away = std::max(away, next.away + moved);
    }
    return away;
}

void LineGuard::join(std::span<const uint32_t> vertices, uint32_t kept, Vec3d point) {
    const double away = away_joined(vertices, point);
    for (const uint32_t v : vertices) {
        if (!on_line_[v]) continue;
        for (const Next& next : next_[v]) {
            if (next.vertex == no_index) continue;
            relink(next.vertex, v, {kept, next.away + length(mesh_.position(v) - point)});
        }
    }
    next_[kept] = {{{no_index, away}, {no_index, away}}};
}

void LineGuard::set_line(uint32_t vertex, std::span<const uint32_t> neighbours) {
    // Where a neighbour is on no line, nobody knows how far that edge is away: as far as any here.
    const double away = std::max(next_[vertex][0].away, next_[vertex][1].away);
    next_[vertex] = {{{no_index, away}, {no_index, away}}};
    on_line_[vertex] = !neighbours.empty();
    if (neighbours.empty()) return;
    for (const size_t side : {size_t{0}, size_t{1}}) {
        const uint32_t v = neighbours[side];
        next_[vertex][side].vertex = v;
        if (!on_line_[v]) continue;
        for (const Next& back : next_[v])
            if (back.vertex == vertex) next_[vertex][side].away = back.away;
    }
}

void LineGuard::relink(uint32_t vertex, uint32_t from, Next to) {
    if (!on_line_[vertex]) return;
    for (Next& next : next_[vertex])
        if (next.vertex == from) next = to;
}

}  // namespace coppice
