#include "core/simplify/edge_collapse.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace coppice {

EdgeCollapse::EdgeCollapse(const Mesh& source, const Target& target, const CollapseOptions& options,
                           const MakeError& make_error, const Watch& watch)
    : GuardedMesh(source, target, options.guards, watch),
      steps_(watch),
      has_values_(!source.attributes.empty() || !source.morph_targets.empty()),
      options_(options),
      clouds_(mesh_, source, options.scales, watch),
      projection_(mesh_),
      error_(make_error({mesh_, features_.edges, clouds_, projection_, options.pair_distance > 0})),
      wedge_map_(mesh_, clouds_),
      values_(source, mesh_.wedge_sources()),
      around_(mesh_.vertex_count(), watch),
      around_other_(mesh_.vertex_count(), watch) {
    watch.check();
    if (!(options.pair_distance > 0)) return;
    joins_ = std::make_unique<Joins>(
        Joins{VertexPairs(mesh_, features_.edges, watch), VertexClassifier(mesh_, watch)});
    set_pair_distance(options.pair_distance, watch);
}

// Where the shading has an edge that the texture has not, what moves would get as many texture coordinates as
// it has normals.
bool EdgeCollapse::parts_texture(uint32_t vertex) const {
    if (!uvs_.any()) return false;
    for (uint32_t w = mesh_.wedge_begin(vertex); w < mesh_.wedge_end(vertex); ++w)
        if (mesh_.wedge_chart(w) != w) return true;
    return false;
}

Freedom EdgeCollapse::freedom_between(uint32_t a, uint32_t b) const {
    const VertexKind kind = this->kind(a);
    if (kind != this->kind(b) || parts_texture(a) || parts_texture(b)) return Freedom::end_point;
    if (kind == VertexKind::manifold) return options_.freedom;
    return is_on_line(a) ? std::min(options_.freedom, Freedom::segment) : Freedom::end_point;
}

// With pairs, two vertices may be asked for that were one's candidate and the other has changed since.
EdgeCollapse::Tie EdgeCollapse::tie_between(uint32_t a, uint32_t b) const {
    if (!joins_ || !joins_->pairs.has_contained(a) || !joins_->pairs.has_contained(b)) return Tie::edge;
    if (!mesh_.is_live_vertex(a) || !mesh_.is_live_vertex(b)) return Tie::none;
    if (mesh_.valence(a) > mesh_.valence(b)) std::swap(a, b);
    if (mesh_.valence(a) > largest_removable_valence) return Tie::edge;  // neither goes
    for (uint32_t c = mesh_.first_corner(a); c != no_index; c = mesh_.corner_after(c)) {
        if (mesh_.corner_vertex(CollapseMesh::next_corner(c)) == b ||
            mesh_.corner_vertex(CollapseMesh::previous_corner(c)) == b)
            return Tie::edge;
    }
    const double distance = length(mesh_.position(a) - mesh_.position(b));
    const bool near = is_paired(a) && is_paired(b) && distance <= joins_->pairs.distance();
    return near ? Tie::nearness : Tie::none;
}

bool EdgeCollapse::find_wedges(uint32_t removed, uint32_t kept, Tie tie) {
    return tie == Tie::edge ? wedge_map_.find(removed, kept) : wedge_map_.find_across(removed, kept, values_);
}

bool EdgeCollapse::allowed(uint32_t removed, uint32_t kept, Tie tie, bool ring_gathered) {
    if (tie == Tie::nearness) return rules_.kinds_allow_join(removed, kept);
    if (!rules_.reads_neighbours(removed)) return rules_.kinds_allow(removed, kept, around_);
    if (ring_gathered) return rules_.kinds_allow(removed, kept, around_);
    if (mesh_.valence(removed) > largest_removable_valence) return false;
    around_other_.gather(mesh_, removed);
    return rules_.kinds_allow(removed, kept, around_other_);
}

std::optional<EdgeCollapse::Merge> EdgeCollapse::place(uint32_t removed, uint32_t kept, Tie tie,
                                                       Freedom freedom) {
    steps_.add(mesh_.valence(removed));
    if (!find_wedges(removed, kept, tie)) {
        refusals_.add(Refusal::locked);
        return {};
    }
    const std::optional<Placed> placed =
        error_->place(removed, kept, freedom, tie == Tie::nearness, wedge_map_.wedges());
    if (!placed) {
        refusals_.add_beyond_threshold();
        return {};
    }
    const bool moves = tie == Tie::nearness || !(placed->at == mesh_.position(kept));
    return Merge{removed, kept, *placed, moves, tie};
}

// around_ holds the owner's ring, if ring_gathered.
std::optional<EdgeCollapse::Merge> EdgeCollapse::best_merge(uint32_t owner, uint32_t other, Tie tie,
                                                            bool ring_gathered) {
    const bool forward = allowed(owner, other, tie, ring_gathered);
    const bool backward = options_.freedom != Freedom::end_point && allowed(other, owner, tie, false);
    if (!forward && !backward) {
        refusals_.add(Refusal::locked);
        return {};
    }
    const Freedom freedom = freedom_between(owner, other);
    if (freedom != Freedom::end_point && forward && backward) {
        const bool owner_goes = mesh_.valence(owner) <= mesh_.valence(other);
        return owner_goes ? place(owner, other, tie, freedom) : place(other, owner, tie, freedom);
    }
    std::optional<Merge> best;
    if (forward) best = place(owner, other, tie, Freedom::end_point);
    if (backward) {
        const std::optional<Merge> back = place(other, owner, tie, Freedom::end_point);
        if (back && (!best || back->placed.error < best->placed.error)) best = back;
    }
    return best;
}

std::optional<double> EdgeCollapse::cost(uint32_t owner, uint32_t other) {
    if (options_.freedom != Freedom::end_point && other < owner) return {};
    const Tie tie = tie_between(owner, other);
    if (tie == Tie::none) return {};
    const std::optional<Merge> merge = best_merge(owner, other, tie, false);
    return merge ? std::optional(merge->placed.error) : std::nullopt;
}

// Around a vertex inside the surface each neighbour comes next at one corner, so none has to be looked for.
void EdgeCollapse::neighbours(uint32_t vertex, std::vector<uint32_t>& out) {
    out.clear();
    if (kind(vertex) == VertexKind::manifold) {
        for (uint32_t c = mesh_.first_corner(vertex); c != no_index; c = mesh_.corner_after(c))
            out.push_back(mesh_.corner_vertex(CollapseMesh::next_corner(c)));
        return;
    }
    around_other_.gather(mesh_, vertex);
    out = around_other_.all();
}

void EdgeCollapse::ring(uint32_t vertex, std::vector<uint32_t>& out) {
    neighbours(vertex, out);
    if (joins_) joins_->pairs.append(vertex, out);
}

Candidate EdgeCollapse::next_candidate(uint32_t owner, std::optional<Candidate> after) {
    if (mesh_.valence(owner) > largest_removable_valence) {
        refusals_.add(Refusal::locked);
        return {};
    }
    if (rules_.reads_neighbours(owner)) around_.gather(mesh_, owner);
    neighbours(owner, ring_);
    const size_t edges = ring_.size();
    if (joins_) joins_->pairs.append(owner, ring_);
    Candidate best;
    for (size_t i = 0; i < ring_.size(); ++i) {
        const uint32_t other = ring_[i];
        if (options_.freedom != Freedom::end_point && other < owner) continue;
        const std::optional<Merge> merge =
            best_merge(owner, other, i < edges ? Tie::edge : Tie::nearness, true);
        if (!merge) continue;
        const Candidate candidate = {other, merge->placed.error};
        if (after && !(*after < candidate)) continue;
        if (candidate < best) best = candidate;
    }
    return best;
}

Refusal EdgeCollapse::check(const Merge& m) {
    if (!find_wedges(m.removed, m.kept, m.tie)) return Refusal::locked;
    const Refusal refusal = m.moves ? check_move(m) : check_end_point(m.removed, m.kept);
    if (refusal != Refusal::none) return refusal;
    next_deviation_ = m.moves ? deviation(m) : deviation_.after(m.removed, m.kept);
    return check_deviation(next_deviation_);
}

Refusal EdgeCollapse::check_end_point(uint32_t removed, uint32_t kept) {
    if (!bounds_.may_remove(removed)) return Refusal::bounds;
    if (!lines_.may_remove(removed, kept)) return Refusal::topology;
    if (!uvs_.may_collapse(removed, kept, wedge_map_.wedges())) return Refusal::topology;
    return rules_.check(removed, kept);
}

Refusal EdgeCollapse::check_move(const Merge& m) {
    const std::array<uint32_t, 2> ends = {m.removed, m.kept};
    if (!bounds_.may_merge(ends, m.placed.at)) return Refusal::bounds;
    if (!lines_allow(m)) return Refusal::topology;
    if (has_values_) projection_.project(m.removed, m.kept, wedge_map_.wedges(), m.placed.at);
    if (!rules_.keeps_topology(m.removed, m.kept, m.tie == Tie::nearness)) return Refusal::topology;
    if (m.tie == Tie::nearness && !may_join(m)) return Refusal::topology;
    const bool sound = may_move_fan(m.removed, m.kept, m) && may_move_fan(m.kept, m.removed, m);
    return sound ? Refusal::none : Refusal::topology;
}

bool EdgeCollapse::lines_allow(const Merge& m) const {
    const std::array<uint32_t, 2> ends = {m.removed, m.kept};
    if (m.tie == Tie::nearness) return lines_.may_join(ends, m.placed.at);
    return !is_on_line(m.kept) || lines_.may_merge(ends, m.placed.at);
}

bool EdgeCollapse::may_join(const Merge& m) {
    return rules_.closes_or_leads_on(m.removed, m.kept, joins_->pairs.distance()) && keeps_area(m);
}

// Of a join, after which all triangles are still there.
bool EdgeCollapse::keeps_area(const Merge& m) const {
    if (!options_.area_tolerance) return true;
    double before = 0, after = 0;
    for (const uint32_t vertex : {m.removed, m.kept}) {
        for (uint32_t c = mesh_.first_corner(vertex); c != no_index; c = mesh_.corner_after(c)) {
            const Vec3d a = mesh_.position(mesh_.corner_vertex(CollapseMesh::next_corner(c)));
            const Vec3d b = mesh_.position(mesh_.corner_vertex(CollapseMesh::previous_corner(c)));
            before += 0.5 * length(area_normal(mesh_.position(vertex), a, b));
            after += 0.5 * length(area_normal(m.placed.at, a, b));
        }
    }
    const double disc = std::numbers::pi * joins_->pairs.distance() * joins_->pairs.distance();
    return std::abs(after - before) <= std::min(*options_.area_tolerance * before, disc);
}

// The triangles at one end that are not at the other: none may be turned over, in space or in its texture.
bool EdgeCollapse::may_move_fan(uint32_t vertex, uint32_t other, const Merge& m) {
    const Vec3f facing = mean_facing(m);
    const uint32_t first = mesh_.wedge_begin(m.removed);
    for (uint32_t c = mesh_.first_corner(vertex); c != no_index; c = mesh_.corner_after(c)) {
        if (mesh_.corner_vertex(CollapseMesh::next_corner(c)) == other ||
            mesh_.corner_vertex(CollapseMesh::previous_corner(c)) == other) {
            continue;
        }
        if (!rules_.keeps_orientation(c, m.placed.at, facing)) return false;
        if (!uvs_.any()) continue;
        const uint32_t wedge = mesh_.corner_wedge(c);
        const uint32_t becomes = vertex == m.kept ? wedge : wedge_map_.wedges()[wedge - first];
        if (!uvs_.may_blend(c, projection_.shares(becomes))) return false;
    }
    return true;
}

// Where the surface faced at what the vertex that stays will stand for.
Vec3f EdgeCollapse::mean_facing(const Merge& m) const {
    return to_float(normalized(to_double(rules_.facing(m.removed)) + to_double(rules_.facing(m.kept))));
}

// Both ends are measured from what replaces both rings, on top of what each has gathered before.
double EdgeCollapse::deviation(const Merge& m) const {
    const Vec3d p = mesh_.position(m.removed), q = mesh_.position(m.kept), at = m.placed.at;
    double from_p = length(p - at), from_q = length(q - at);
    // A gap that closes is as far from the surface that was there.
    if (m.tie == Tie::nearness)
        return std::max(deviation_.carried(m.removed) + from_p, deviation_.carried(m.kept) + from_q);
    for (const auto& [vertex, other] : {std::pair(m.removed, m.kept), std::pair(m.kept, m.removed)}) {
        for (uint32_t c = mesh_.first_corner(vertex); c != no_index; c = mesh_.corner_after(c)) {
            const uint32_t a = mesh_.corner_vertex(CollapseMesh::next_corner(c));
            const uint32_t b = mesh_.corner_vertex(CollapseMesh::previous_corner(c));
            if (a == other || b == other) continue;
            from_p = std::min(from_p, distance_to_triangle(p, at, mesh_.position(a), mesh_.position(b)));
            from_q = std::min(from_q, distance_to_triangle(q, at, mesh_.position(a), mesh_.position(b)));
        }
    }
    return std::max(deviation_.carried(m.removed) + from_p, deviation_.carried(m.kept) + from_q);
}

void EdgeCollapse::blend_wedges(uint32_t kept) {
    for (uint32_t w = mesh_.wedge_begin(kept); w < mesh_.wedge_end(kept); ++w) {
        const std::span<const WedgeShare> shares = projection_.shares(w);
        if (shares.empty()) continue;
        values_.blend(shares, w);
        clouds_.blend(shares, w);
        uvs_.blend(shares, w);
    }
}

void EdgeCollapse::apply(const Merge& m) {
    if (m.moves && has_values_) blend_wedges(m.kept);
    error_->merge(m.removed, m.kept, wedge_map_.wedges());
    deviation_.merge(m.kept, next_deviation_);
    const std::array<uint32_t, 2> ends = {m.removed, m.kept};
    if (m.moves) {
        bounds_.merge(ends, m.kept, m.placed.at);
        if (m.tie == Tie::nearness) {
            lines_.join(ends, m.kept, m.placed.at);
        } else if (is_on_line(m.kept)) {
            lines_.merge(ends, m.kept, m.placed.at);
        }
        rules_.set_facing(m.kept, mean_facing(m));
    } else {
        bounds_.remove(m.removed);
        lines_.remove(m.removed, m.kept);
    }
    mesh_.collapse(m.removed, m.kept, wedge_map_.wedges());
    if (m.moves) mesh_.move(m.kept, m.placed.at);
    if (joins_) settle_pairs(m);
}

// A join changes what the surface is like at the vertex that stays and wherever a border closed.
void EdgeCollapse::settle_pairs(const Merge& m) {
    joins_->pairs.erase(m.removed);
    if (m.moves) joins_->pairs.move(m.kept);
    if (m.tie == Tie::edge) return;
    settle(m.kept);
    for (const uint32_t vertex : rules_.zipped()) settle(vertex);
}

void EdgeCollapse::settle(uint32_t vertex) {
    auto& [pairs, classifier, lines] = *joins_;
    rules_.set_kind(vertex, classifier.classify(vertex));
    lines.clear();
    classifier.append_lines(vertex, lines);
    error_->set_lines(vertex, lines);
    lines_.set_line(vertex, is_on_line(vertex) ? classifier.line_neighbours() : std::vector<uint32_t>());
    const bool has_border =
        std::any_of(lines.begin(), lines.end(), [](const FeatureEdge& edge) { return edge.is_border; });
    if (!has_border) pairs.erase(vertex);
}

// What an end point costs does not matter any more.
std::optional<EdgeCollapse::Merge> EdgeCollapse::merge_again(uint32_t owner, uint32_t other, Tie tie) {
    if (options_.freedom != Freedom::end_point) return best_merge(owner, other, tie, false);
    if (joins_ && !allowed(owner, other, tie, false)) {  // kinds change where borders were joined
        refusals_.add(Refusal::locked);
        return {};
    }
    return Merge{owner, other, {mesh_.position(other), 0}, tie == Tie::nearness, tie};
}

std::optional<Collapsed> EdgeCollapse::try_collapse(uint32_t owner, uint32_t other) {
    const Tie tie = tie_between(owner, other);
    if (tie == Tie::none) return {};
    const std::optional<Merge> merge = merge_again(owner, other, tie);
    if (!merge) return {};
    const uint64_t searched = rules_.searched();
    const Refusal refusal = check(*merge);
    steps_.add(size_t{8} * mesh_.valence(merge->removed) +
               (rules_.searched() - searched));  // each rule looks
    if (refusal != Refusal::none) {
        refusals_.add(refusal);
        return {};
    }
    apply(*merge);
    return Collapsed{merge->removed, merge->kept};
}

bool EdgeCollapse::may_collapse(uint32_t removed, uint32_t kept) {
    if (!allowed(removed, kept, Tie::edge, false)) {
        refusals_.add(Refusal::locked);
        return false;
    }
    const Refusal refusal = check({removed, kept, {mesh_.position(kept), 0}});
    if (refusal != Refusal::none) refusals_.add(refusal);
    return refusal == Refusal::none;
}

void EdgeCollapse::flip_edges(const MayFlip& may_flip, const Watch& watch) {
    delaunay_flips(mesh_, uvs_, watch, may_flip);
}

Simplified EdgeCollapse::finish(StopReason reason, const Watch& watch) const {
    return simplified(mesh_.extract(source_, values_, watch), reason);
}

}  // namespace coppice
