#include "core/simplify/collapse_rules.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <span>

#include "core/base/watched_loop.h"

namespace coppice {

namespace {

constexpr double least_cosine_at_once = 0.25;
constexpr double least_cosine_since_start = 0.2;
// Mean over the corners, to where the surface faced there. Thin triangles across a crease lie near the
// surface, but may face anywhere.
constexpr double least_cosine_to_corners = 0.25;
// Beyond a third the rest of the surface there cannot outvote the corners.
constexpr double least_cosine_of_filling = 0.34;
// A triangle is degenerate when twice its area is below this part of its longest edge squared: in single
// precision its normal would mean nothing.
constexpr double degenerate_aspect = 1e-6;

bool is_degenerate(Vec3d a, Vec3d b, Vec3d c, Vec3d normal) {
    const double longest = std::max({squared_length(b - a), squared_length(c - b), squared_length(a - c)});
    return squared_length(normal) <= degenerate_aspect * degenerate_aspect * longest * longest;
}

// Mean cosine between a normal, of any length but none, and where the surface faced at the corners, as far as
// that is known.
double agreement_with_corners(Vec3d normal, const std::array<Vec3f, 3>& facings) {
    double sum = 0, known = 0;
    for (const Vec3f facing : facings) {
        sum += dot(to_double(facing), normal);
        known += facing == Vec3f{} ? 0 : 1;
    }
    return known > 0 ? sum / (known * length(normal)) : 1;
}

// Per vertex the mean of its triangles' normals, weighted by their angles there (the pseudo-normal of
// Baerentzen and Aanaes 2005, which tells inside from outside at any edge): unit, or zero where sheets lie
// back to back.
std::vector<Vec3f> facings(const CollapseMesh& mesh, std::span<const Vec3f> normals, const Watch& watch) {
    struct Sum {
        Vec3d normals;
        double angles = 0;
    };
    std::vector<Sum> sums(mesh.vertex_count());
    for_each_triangle(mesh, watch, [&](uint32_t t, const std::array<uint32_t, 3>& v) {
        std::array<Vec3d, 3> along;  // unit, from each corner to the next
        for (size_t k = 0; k < 3; ++k)
            along[k] = normalized(mesh.position(v[(k + 1) % 3]) - mesh.position(v[k]));
        for (size_t k = 0; k < 3; ++k) {
            const double angle = std::acos(std::clamp(-dot(along[k], along[(k + 2) % 3]), -1.0, 1.0));
            sums[v[k]].normals = sums[v[k]].normals + to_double(normals[t]) * angle;
            sums[v[k]].angles += angle;
        }
    });
    std::vector<Vec3f> result(mesh.vertex_count());
    watched_loop(mesh.vertex_count(), watch, [&](size_t v) {
        if (length(sums[v].normals) > 1e-6 * sums[v].angles)
            result[v] = to_float(normalized(sums[v].normals));
    });
    return result;
}

}  // namespace

CollapseRules::CollapseRules(const CollapseMesh& mesh, std::vector<VertexKind> kinds, const Watch& watch)
    : mesh_(mesh),
      kinds_(std::move(kinds)),
      first_normals_(watched_vector<Vec3f>(mesh.triangle_count(), watch)),
      around_removed_(mesh.vertex_count()),
      around_kept_(mesh.vertex_count()) {
    for_each_triangle(mesh, watch, [&](uint32_t t, const std::array<uint32_t, 3>& v) {
        const Vec3d a = mesh.position(v[0]), b = mesh.position(v[1]), c = mesh.position(v[2]);
        const Vec3d normal = area_normal(a, b, c);
        if (!is_degenerate(a, b, c, normal)) first_normals_[t] = to_float(normalized(normal));
    });
    facing_ = facings(mesh, first_normals_, watch);
}

bool CollapseRules::kinds_allow_join(uint32_t removed, uint32_t kept) const {
    return std::max(mesh_.valence(removed), mesh_.valence(kept)) <= largest_removable_valence &&
           allows(kinds_[removed], kinds_[kept]);
}

bool CollapseRules::kinds_allow(uint32_t removed, uint32_t kept, const Neighbours& around) const {
    if (mesh_.valence(removed) > largest_removable_valence) return false;
    if (!allows(kinds_[removed], kinds_[kept])) return false;
    switch (kinds_[removed]) {
        case VertexKind::border:
            // Of the edges here those of the border have the fewest triangles: one for each layer.
            return std::none_of(around.all().begin(), around.all().end(),
                                [&](uint32_t v) { return around.uses(v) < around.uses(kept); });
        case VertexKind::complex: {
            const uint32_t uses = around.uses(kept);
            // Either all edges here are alike (say, two sheets back to back), or the edge is one of the two
            // of a line that differs from the rest (the rim of such sheets, the foot of a fin).
            const auto alike = std::count_if(around.all().begin(), around.all().end(),
                                             [&](uint32_t v) { return around.uses(v) == uses; });
            return alike == 2 || static_cast<size_t>(alike) == around.all().size();
        }
        default:
            return true;  // a seam's edge is found by the map of its wedges
    }
}

Refusal CollapseRules::check(uint32_t removed, uint32_t kept) {
    if (!keeps_topology(removed, kept)) return Refusal::topology;
    if (!keeps_orientation(removed, kept)) return Refusal::topology;
    return Refusal::none;
}

bool CollapseRules::keeps_topology(uint32_t removed, uint32_t kept, bool joins) {
    around_removed_.gather(mesh_, removed);
    zipped_.clear();
    shared_.assign(around_removed_.all().size(), 0);
    for (uint32_t c = mesh_.first_corner(removed); c != no_index; c = mesh_.corner_after(c)) {
        const uint32_t a = mesh_.corner_vertex(CollapseMesh::next_corner(c));
        const uint32_t b = mesh_.corner_vertex(CollapseMesh::previous_corner(c));
        if (a == kept) ++shared_[around_removed_.find(b)];
        if (b == kept) ++shared_[around_removed_.find(a)];
    }
    const bool gather_kept = mesh_.valence(kept) <= largest_removable_valence;
    if (gather_kept) around_kept_.gather(mesh_, kept);
    for (uint32_t i = 0; i < shared_.size(); ++i) {
        const uint32_t x = around_removed_.all()[i];
        if (x == kept) continue;
        if (!gather_kept && mesh_.valence(x) > largest_removable_valence)
            return false;  // two hubs: too long to search
        const uint32_t to_kept = edge_uses(x, kept, gather_kept);
        if (to_kept == 0) continue;
        if (shared_[i] == 0) {
            if (!joins || !closes_border(removed, kept, x)) return false;
            zipped_.push_back(x);
        }
        const uint32_t to_removed = around_removed_.uses(x);
        const uint32_t after = to_removed + to_kept - 2 * shared_[i];
        if (after == 0 || after > std::max({2U, to_removed, to_kept})) return false;
    }
    return !duplicates(removed, kept);
}

CollapseRules::Spoke CollapseRules::spoke(uint32_t vertex, uint32_t neighbour) const {
    for (uint32_t c = mesh_.first_corner(vertex); c != no_index; c = mesh_.corner_after(c)) {
        const uint32_t next = CollapseMesh::next_corner(c), previous = CollapseMesh::previous_corner(c);
        if (mesh_.corner_vertex(next) == neighbour)
            return {true, mesh_.wedge_chart(mesh_.corner_wedge(next))};
        if (mesh_.corner_vertex(previous) == neighbour)
            return {false, mesh_.wedge_chart(mesh_.corner_wedge(previous))};
    }
    return {};
}

// Whether the edges to both would lie on each other as sides of one surface. How many triangles they have is
// for the caller.
bool CollapseRules::closes_border(uint32_t removed, uint32_t kept, uint32_t common) const {
    const Spoke one = spoke(removed, common), other = spoke(kept, common);
    return one.runs_outwards != other.runs_outwards && one.chart == other.chart;
}

bool CollapseRules::closes_or_leads_on(uint32_t removed, uint32_t kept, double distance) {
    if (!zipped_.empty()) return true;
    gather_border_ends(removed, around_removed_, removed_ends_);
    gather_border_ends(kept, around_kept_, kept_ends_);
    searched_ += removed_ends_.size() * kept_ends_.size();
    for (const BorderEnd& x : removed_ends_) {
        for (const BorderEnd& y : kept_ends_) {
            if (x.runs_outwards == y.runs_outwards) continue;
            if (length(mesh_.position(x.vertex) - mesh_.position(y.vertex)) <= distance) return true;
        }
    }
    return false;
}

// The other ends of the edges of one triangle.
void CollapseRules::gather_border_ends(uint32_t vertex, const Neighbours& around,
                                       std::vector<BorderEnd>& ends) const {
    ends.clear();
    for (uint32_t c = mesh_.first_corner(vertex); c != no_index; c = mesh_.corner_after(c)) {
        const uint32_t next = mesh_.corner_vertex(CollapseMesh::next_corner(c));
        const uint32_t previous = mesh_.corner_vertex(CollapseMesh::previous_corner(c));
        if (around.uses(next) == 1) ends.push_back({next, true});
        if (around.uses(previous) == 1) ends.push_back({previous, false});
    }
}

// Triangles at the edge from `kept` to a vertex.
uint32_t CollapseRules::edge_uses(uint32_t vertex, uint32_t kept, bool ring_gathered) {
    if (ring_gathered) return around_kept_.uses(vertex);
    uint32_t uses = 0;
    searched_ += mesh_.valence(vertex);
    for (uint32_t c = mesh_.first_corner(vertex); c != no_index; c = mesh_.corner_after(c)) {
        uses += mesh_.corner_vertex(CollapseMesh::next_corner(c)) == kept ||
                mesh_.corner_vertex(CollapseMesh::previous_corner(c)) == kept;
    }
    return uses;
}

bool CollapseRules::has_triangle(std::array<uint32_t, 3> corners) {
    std::sort(corners.begin(), corners.end(),
              [this](uint32_t a, uint32_t b) { return mesh_.valence(a) < mesh_.valence(b); });
    const auto [v, a, b] = corners;
    if (mesh_.valence(v) > largest_removable_valence) return true;
    searched_ += mesh_.valence(v);
    for (uint32_t c = mesh_.first_corner(v); c != no_index; c = mesh_.corner_after(c)) {
        const uint32_t next = mesh_.corner_vertex(CollapseMesh::next_corner(c));
        const uint32_t previous = mesh_.corner_vertex(CollapseMesh::previous_corner(c));
        if ((next == a && previous == b) || (next == b && previous == a)) return true;
    }
    return false;
}

// Whether a triangle that moves would land on one that is there, in either orientation.
bool CollapseRules::duplicates(uint32_t removed, uint32_t kept) {
    const auto is_common = [this](uint32_t v) {
        return shared_[around_removed_.find(v)] > 0 ||
               std::find(zipped_.begin(), zipped_.end(), v) != zipped_.end();
    };
    for (uint32_t c = mesh_.first_corner(removed); c != no_index; c = mesh_.corner_after(c)) {
        const uint32_t a = mesh_.corner_vertex(CollapseMesh::next_corner(c));
        const uint32_t b = mesh_.corner_vertex(CollapseMesh::previous_corner(c));
        if (a == kept || b == kept || !is_common(a) || !is_common(b)) continue;
        if (has_triangle({kept, a, b})) return true;
    }
    return false;
}

bool CollapseRules::keeps_orientation(uint32_t removed, uint32_t kept) const {
    for (uint32_t c = mesh_.first_corner(removed); c != no_index; c = mesh_.corner_after(c)) {
        const uint32_t next = mesh_.corner_vertex(CollapseMesh::next_corner(c));
        const uint32_t previous = mesh_.corner_vertex(CollapseMesh::previous_corner(c));
        if (next == kept || previous == kept) continue;
        if (!keeps_orientation(c, mesh_.position(kept), facing_[kept])) return false;
    }
    return true;
}

bool CollapseRules::keeps_orientation(uint32_t corner, Vec3d to, Vec3f facing) const {
    const uint32_t vertex = mesh_.corner_vertex(corner);
    const uint32_t next = mesh_.corner_vertex(CollapseMesh::next_corner(corner));
    const uint32_t previous = mesh_.corner_vertex(CollapseMesh::previous_corner(corner));
    const Vec3d from = mesh_.position(vertex), a = mesh_.position(next), b = mesh_.position(previous);
    const Vec3d before = area_normal(from, a, b), after = area_normal(to, a, b);
    const bool was_degenerate = is_degenerate(from, a, b, before);
    if (is_degenerate(to, a, b, after)) return was_degenerate;
    const double size = length(after);
    if (!was_degenerate && dot(before, after) < least_cosine_at_once * length(before) * size) return false;
    const Vec3f first = first_normals_[corner / 3];
    if (first != Vec3f{} && dot(to_double(first), after) < least_cosine_since_start * size) return false;
    const Vec3f ahead = facing_[next], behind = facing_[previous];
    const double agreement = agreement_with_corners(after, {facing, ahead, behind});
    return agreement >= least_cosine_to_corners ||
           (!was_degenerate && agreement >= agreement_with_corners(before, {facing_[vertex], ahead, behind}));
}

std::optional<Vec3f> CollapseRules::normal_of_filling(const std::array<uint32_t, 3>& vertices,
                                                      Vec3f facing) const {
    const Vec3d a = mesh_.position(vertices[0]), b = mesh_.position(vertices[1]),
                c = mesh_.position(vertices[2]);
    const Vec3d area = area_normal(a, b, c);
    if (is_degenerate(a, b, c, area)) return {};
    const Vec3d normal = normalized(area);
    if (facing != Vec3f{} && dot(to_double(facing), normal) < least_cosine_at_once) return {};
    const std::array<Vec3f, 3> corners = {facing_[vertices[0]], facing_[vertices[1]], facing_[vertices[2]]};
    if (agreement_with_corners(normal, corners) < least_cosine_of_filling) return {};
    return to_float(normal);
}

}  // namespace coppice
