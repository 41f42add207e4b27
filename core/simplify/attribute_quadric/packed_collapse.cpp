#include "core/simplify/attribute_quadric/packed_collapse.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>
#include <numeric>
#include <utility>

#include "core/base/watched_loop.h"
#include "core/mesh/weld.h"
#include "core/simplify/bounds_guard.h"
#include "core/simplify/deviation.h"
#include "core/simplify/line_guard.h"

namespace coppice {

namespace {

constexpr double border_weight = 10, seam_weight = 1;  // of the plane across a line, times its edge squared
constexpr float no_cost = -1;
// A pass takes nothing that costs more than this times what the last edge would that it needs.
constexpr float usual_patience = 1.5F;
constexpr auto box_tolerance = static_cast<float>(packed_tolerance * bounds_tolerance_of_diagonal);
constexpr auto line_tolerance = static_cast<float>(packed_tolerance * line_tolerance_of_diagonal);

}  // namespace

PackedCollapse::PackedCollapse(const Mesh& source, const PackedOptions& options, const Watch& watch)
    : source_(source),
      options_(options),
      mesh_(source, watch),
      attributes_(mesh_, source, options.weights, watch),
      first_wedges_(mesh_.wedge_source),
      values_(source, first_wedges_),
      blends_values_(!source.morph_targets.empty() || !attributes_.holds_all_of(source)) {
    wedge_origin_.resize(mesh_.wedge_count());
    std::iota(wedge_origin_.begin(), wedge_origin_.end(), 0U);
    away_.resize(mesh_.vertex_count());
    moved_.resize(mesh_.vertex_count());
    changed_.assign(mesh_.vertex_count(), 1);
    costs_.resize(mesh_.triangles.size());
    if (options_.lock_borders)
        std::replace(mesh_.kinds.begin(), mesh_.kinds.end(), VertexKind::border, VertexKind::corner);
    find_facing(watch);
    add_planes(watch);
    add_lines(watch);
}

void PackedCollapse::find_facing(const Watch& watch) {
    watched_resize(facing_, mesh_.vertex_count(), watch);
    watched_loop(mesh_.triangle_count(), watch, [&](size_t t) {
        const uint32_t* v = &mesh_.triangles[3 * t];
        const Vec3f area = area_normal(mesh_.positions[v[0]], mesh_.positions[v[1]], mesh_.positions[v[2]]);
        for (size_t k = 0; k < 3; ++k) facing_[v[k]] = facing_[v[k]] + area;
    });
    watched_loop(facing_.size(), watch, [&](size_t v) { facing_[v] = normalized(facing_[v]); });
}

// A triangle's plane passes through its corners, so about each of them it has no offset.
void PackedCollapse::add_planes(const Watch& watch) {
    planes_.clear();
    watched_resize(planes_, mesh_.vertex_count(), watch);
    watched_loop(mesh_.triangle_count(), watch, [&](size_t t) {
        const uint32_t* v = &mesh_.triangles[3 * t];
        const Vec3f area = area_normal(mesh_.positions[v[0]], mesh_.positions[v[1]], mesh_.positions[v[2]]);
        const float size = length(area);
        if (!(size > 0)) return;
        const Vec3f n = area * (1 / size);
        float weight = size / 6;
        if (options_.instance_weight) weight *= static_cast<float>(options_.instance_weight(to_double(n)));
        CentredQuadric q;
        q.add_square(n, weight);
        q.weight = weight;
        for (size_t k = 0; k < 3; ++k) planes_[v[k]] += q;
    });
}

// Across borders and seams: through the edge, perpendicular to its triangle.
void PackedCollapse::add_lines(const Watch& watch) {
    watched_loop(mesh_.vertex_count(), watch, [&](size_t i) {
        const auto v = static_cast<uint32_t>(i);
        if (mesh_.kinds[v] == VertexKind::manifold || mesh_.is_hub(v)) return;
        for (uint32_t s = mesh_.first_spoke[v]; s < mesh_.first_spoke[v + 1]; ++s) {
            const auto [next, previous] = mesh_.spokes[s];
            if (mesh_.kinds[next] == VertexKind::manifold) continue;
            const std::optional<uint32_t> twin = mesh_.against(v, next);
            const auto [own, ahead, behind] = mesh_.wedges(v, s);
            const auto other = twin ? mesh_.wedges(v, *twin) : std::array<uint32_t, 3>{};
            if (twin && other[0] == own && other[2] == ahead) continue;
            const Vec3f edge = mesh_.positions[next] - mesh_.positions[v];
            const Vec3f normal = cross(edge, mesh_.positions[previous] - mesh_.positions[v]);
            const Vec3f across = normalized(cross(edge, normal));
            const double weight = twin ? seam_weight : border_weight;
            for (const uint32_t end : {v, next})
                planes_[end].add_square(across, static_cast<float>(weight) * squared_length(edge));
        }
    });
}

// Each edge is found at one of its corners alone.
std::optional<PackedCollapse::Merge> PackedCollapse::merge_along(uint32_t from) const {
    using enum VertexKind;
    const uint32_t to = from % 3 == 2 ? from - 2 : from + 1;
    const uint32_t vertex = mesh_.triangles[from], next = mesh_.triangles[to];
    const VertexKind a = mesh_.kinds[vertex], b = mesh_.kinds[next];
    if (a != manifold && b != manifold) return line_merge(from, to);
    if (next < vertex) return {};
    if (a == b) return Merge{next, vertex, true};
    return a == manifold ? Merge{vertex, next, false} : Merge{next, vertex, false};
}

std::optional<PackedCollapse::Merge> PackedCollapse::line_merge(uint32_t from, uint32_t to) const {
    using enum VertexKind;
    const uint32_t vertex = mesh_.triangles[from], next = mesh_.triangles[to];
    const VertexKind a = mesh_.kinds[vertex], b = mesh_.kinds[next];
    if (a == complex || b == complex) return {};
    const std::optional<uint32_t> twin = mesh_.against(vertex, next);
    VertexKind line = border;
    if (twin) {
        if (next < vertex || !mesh_.has_wedges()) return {};
        const auto there = mesh_.wedges(vertex, *twin);
        if (mesh_.corner_wedges[from] == there[0] && mesh_.corner_wedges[to] == there[2]) return {};
        line = seam;
    }
    if (a == line && b == line) return Merge{next, vertex, true};
    if (a == line && b == corner) return Merge{vertex, next, false};
    if (a == corner && b == line) return Merge{next, vertex, false};
    return {};
}

// The wedges that the triangles at the edge pair: one, or two along a seam.
void PackedCollapse::find_pairs(const Merge& m) {
    pair_count_ = 0;
    if (!attributes_.any() && !mesh_.has_wedges()) return;
    const Vec3f offset = mesh_.positions[m.removed] - mesh_.positions[m.kept];
    for (uint32_t s = mesh_.first_spoke[m.removed]; s < mesh_.first_spoke[m.removed + 1]; ++s) {
        const bool ahead = now(mesh_.spokes[s].next) == m.kept;
        if (!ahead && now(mesh_.spokes[s].previous) != m.kept) continue;
        const auto wedges = mesh_.wedges(m.removed, s);
        const uint32_t removed = wedge_now(wedges[0]), kept = wedge_now(wedges[ahead ? 1 : 2]);
        if (pair_count_ > 0 && pairs_[0].removed == removed) continue;
        if (pair_count_ == 2) return;
        WedgeQuadrics::Pair& pair = pairs_[pair_count_++];
        pair.removed = removed, pair.kept = kept;
        if (attributes_.any()) attributes_.join(offset, pair);
    }
}

CentredQuadric PackedCollapse::planes_of(const Merge& m, Vec3f offset) const {
    CentredQuadric q = planes_[m.removed].seen_from(offset);
    q += planes_[m.kept];
    return q;
}

float PackedCollapse::cost(const Merge& m) {
    const Vec3f offset = mesh_.positions[m.removed] - mesh_.positions[m.kept];
    CentredQuadric q = planes_of(m, offset);
    pair_count_ = 0;
    if (attributes_.any()) find_pairs(m);
    if (!m.moves) {
        float sum = q.c;
        for (uint32_t i = 0; i < pair_count_; ++i) sum += attributes_.error_with_values_kept(pairs_[i]);
        return std::max(0.0F, sum);
    }
    for (uint32_t i = 0; i < pair_count_; ++i) q += attributes_.error(pairs_[i]);
    return std::max(0.0F, q(least_point<float>(q, offset, nullptr)));
}

// The same for edges both of whose ends may move, without attributes, in fours.
void PackedCollapse::cost_planes(const std::array<uint32_t, lane_count>& corners, uint32_t count) {
    std::array<CentredQuadric, lane_count> removed, kept;
    Vec3<Lanes> offset = {};
    for (uint32_t i = 0; i < count; ++i) {
        const uint32_t from = corners[i], to = from % 3 == 2 ? from - 2 : from + 1;
        const uint32_t a = mesh_.triangles[from], b = mesh_.triangles[to];
        removed[i] = planes_[b], kept[i] = planes_[a];
        const Vec3f along = mesh_.positions[b] - mesh_.positions[a];
        offset.x[i] = along.x, offset.y[i] = along.y, offset.z[i] = along.z;
    }
    BasicQuadric<Lanes> q = together(removed).seen_from(offset);
    q += together(kept);
    const Lanes costs = q(least_point<Lanes>(q, offset, nullptr));
    for (uint32_t i = 0; i < count; ++i) costs_[corners[i]] = std::max(0.0F, costs[i]);
}

// What none of whose ends has changed costs what it did.
void PackedCollapse::rank(const Watch& watch) {
    std::array<uint32_t, lane_count> waiting{};
    uint32_t count = 0;
    watched_loop(mesh_.triangle_count(), watch, [&](size_t t) {
        const auto first = static_cast<uint32_t>(3 * t);
        const std::array<uint8_t, 3> changed = {changed_[mesh_.triangles[first]],
                                                changed_[mesh_.triangles[first + 1]],
                                                changed_[mesh_.triangles[first + 2]]};
        for (uint32_t k = 0; k < 3; ++k) {
            if ((changed[k] | changed[k == 2 ? 0 : k + 1]) == 0) continue;
            const std::optional<Merge> merge = merge_along(first + k);
            if (merge && merge->moves && !attributes_.any()) {
                waiting[count++] = first + k;
                if (count == lane_count) cost_planes(waiting, std::exchange(count, 0));
            } else {
                costs_[first + k] = merge ? cost(*merge) : no_cost;
            }
        }
    });
    cost_planes(waiting, count);
}

// About what the edge costs that has so many cheaper ones: a sixteenth too much, at most.
float PackedCollapse::cost_of(uint64_t place, const Watch& watch) const {
    constexpr uint32_t digits = 12;
    std::array<uint32_t, 1U << digits> counts{};
    watched_loop(costs_.size(), watch, [&](size_t corner) {
        if (costs_[corner] >= 0) ++counts[std::bit_cast<uint32_t>(costs_[corner]) >> (31 - digits)];
    });
    uint64_t sum = 0;
    uint32_t digit = 0;
    while (digit + 1 < counts.size() && sum + counts[digit] <= place) sum += counts[digit++];
    if (sum + counts[digit] <= place) return std::numeric_limits<float>::max();
    return std::bit_cast<float>(((digit + 1) << (31 - digits)) - 1);
}

// By the upper bits of the cost, two digits of 9: what is a quarter of one percent apart is equal.
void PackedCollapse::sort_up_to(float dearest, const Watch& watch) {
    order_.clear();
    watched_loop(costs_.size(), watch, [&](size_t corner) {
        if (costs_[corner] >= 0 && costs_[corner] <= dearest) order_.push_back(static_cast<uint32_t>(corner));
    });
    const auto key = [this](uint32_t corner) { return std::bit_cast<uint32_t>(costs_[corner]) >> 14; };
    sorted_.resize(order_.size());
    for (const uint32_t shift : {0U, 9U}) {
        std::array<uint32_t, 513> begin{};
        watched_loop(order_.size(), watch, [&](size_t i) { ++begin[(key(order_[i]) >> shift & 511U) + 1]; });
        std::partial_sum(begin.begin(), begin.end(), begin.begin());
        watched_loop(order_.size(), watch,
                     [&](size_t i) { sorted_[begin[key(order_[i]) >> shift & 511U]++] = order_[i]; });
        order_.swap(sorted_);
    }
}

bool PackedCollapse::is_met(const Target& target) const {
    return (target.triangles && mesh_.triangle_count() <= *target.triangles) ||
           (target.vertices && mesh_.vertex_count() <= *target.vertices);
}

PackedCollapse::ToGo PackedCollapse::to_go(const Target& target) const {
    return {mesh_.triangle_count() - target.triangles.value_or(0),
            mesh_.vertex_count() - target.vertices.value_or(0)};
}

void PackedCollapse::run(const Target& target, const Watch& watch) {
    carries_error_ = target.error_model_units || options_.measures_anew;
    error_limit_ = std::numeric_limits<float>::infinity();
    if (target.error_model_units)
        error_limit_ = static_cast<float>(*target.error_model_units / std::max(mesh_.diagonal, 1e-300));
    carried_.assign(carries_error_ ? mesh_.vertex_count() : 0, 0);
    const double start = mesh_.triangle_count();
    patience_ = usual_patience;
    while (!is_met(target)) {
        const ToGo before = to_go(target);
        const uint64_t gone = pass(before, watch);
        const auto goal = static_cast<double>(target.triangles.value_or(0));
        watch.report(std::min(1.0, (start - mesh_.triangle_count()) / std::max(1.0, start - goal)));
        // Where little goes, dearer edges have to; where hardly anything does, it is not worth a pass.
        const double wanted = static_cast<double>(before.triangles) * options_.share_of_pass;
        const bool hardly = 1000 * gone <= before.triangles;
        if (hardly && !std::isfinite(patience_)) return;
        patience_ = hardly ? std::numeric_limits<float>::infinity()
                           : (static_cast<double>(gone) < 0.1 * wanted ? 2 * patience_ : usual_patience);
    }
}

uint64_t PackedCollapse::pass(const ToGo& to_go, const Watch& watch) {
    vertex_becomes_.resize(mesh_.vertex_count());
    std::iota(vertex_becomes_.begin(), vertex_becomes_.end(), 0U);
    wedge_becomes_.resize(mesh_.has_wedges() ? mesh_.wedge_count() : 0);
    std::iota(wedge_becomes_.begin(), wedge_becomes_.end(), 0U);
    rank(watch);
    changed_.assign(mesh_.vertex_count(), 0);
    const uint64_t collapses = std::min(to_go.triangles / 2, to_go.vertices);
    const double wanted = static_cast<double>(collapses) * options_.share_of_pass;
    sort_up_to(cost_of(static_cast<uint64_t>(wanted), watch) * patience_, watch);

    uint64_t triangles = 0, vertices = 0;
    WatchedSteps steps(watch);
    for (const uint32_t corner : order_) {
        steps.add(1);
        if (triangles >= to_go.triangles || vertices >= to_go.vertices) break;
        const Merge merge = *merge_along(corner);
        if (is_taken(merge.removed) || is_taken(merge.kept)) continue;
        steps.add(size_t{4} * (mesh_.valence(merge.removed) + mesh_.valence(merge.kept)));
        const uint32_t gone = try_collapse(merge);
        triangles += gone;
        vertices += gone > 0 ? 1 : 0;
    }
    if (triangles > 0) pack(watch);
    if (triangles > 0 && options_.measures_anew) {
        add_planes(watch);
        add_lines(watch);
        std::fill(changed_.begin(), changed_.end(), uint8_t{1});
    }
    return triangles;
}

void PackedCollapse::pack(const Watch& watch) {
    const Renumbering numbers =
        mesh_.compact(vertex_becomes_, mesh_.has_wedges() ? wedge_becomes_ : vertex_becomes_, watch);
    renumber(planes_, numbers.vertices, numbers.vertices_left, watch);
    renumber(facing_, numbers.vertices, numbers.vertices_left, watch);
    if (carries_error_) renumber(carried_, numbers.vertices, numbers.vertices_left, watch);
    renumber(away_, numbers.vertices, numbers.vertices_left, watch);
    renumber(moved_, numbers.vertices, numbers.vertices_left, watch);
    renumber(wedge_origin_, numbers.wedges, numbers.wedges_left, watch);
    renumber(changed_, numbers.vertices, numbers.vertices_left, watch);
    renumber(costs_, numbers.triangles, numbers.triangles_left, watch, 3);
    attributes_.renumber_wedges(numbers, watch);
}

// Triangles that went; none where a rule is broken.
uint32_t PackedCollapse::try_collapse(const Merge& m) {
    if (!gather(m.removed, removed_ring_) || !gather(m.kept, kept_ring_)) return 0;
    if (!has_sound_link(removed_ring_, kept_ring_, m.kept)) return 0;
    volume_ = {};
    const Vec3f origin = mesh_.positions[m.kept];
    gather_fan(m.removed, m.kept, origin, removed_ring_, removed_fan_);
    gather_fan(m.kept, m.removed, origin, kept_ring_, kept_fan_);
    if (!leaves_none_out(m)) return 0;
    const Vec3f offset = mesh_.positions[m.removed] - mesh_.positions[m.kept];
    const CentredQuadric planes = planes_of(m, offset);
    find_pairs(m);
    const std::optional<Vec3f> at = place(m, planes, offset);
    if (!at) return 0;
    // Between vertices planes know more, at spikes distances do.
    float error = planes.weight > 0 ? std::sqrt(std::max(0.0F, planes(*at)) / planes.weight) : 0;
    if (carries_error_) error = std::max(error, distance_after(m, *at));
    if (error > error_limit_) return 0;
    if (mesh_.kinds[m.removed] != VertexKind::manifold) {
        const std::optional<float> away = line_away(m, *at);
        if (!away) return 0;
        away_[m.kept] = *away;
    }
    largest_error_ = std::max(largest_error_, error);
    if (carries_error_) carried_[m.kept] = error;
    apply(m, *at, planes, offset);
    return removed_ring_.count - removed_fan_.count;
}

// As Deviation has it: both ends are measured from the triangles that take the place of theirs, on top of
// what each has gathered before.
float PackedCollapse::distance_after(const Merge& m, Vec3f at) const {
    const Vec3d tip = to_double(at);
    const auto distance = [&](Vec3f from) {
        return std::min(removed_fan_.distance(to_double(from), tip),
                        kept_fan_.distance(to_double(from), tip));
    };
    return static_cast<float>(std::max(double{carried_[m.removed]} + distance(removed_fan_.tip),
                                       double{carried_[m.kept]} + distance(kept_fan_.tip)));
}

// Around the inside of a chart each neighbour comes next once; elsewhere some are only previous. False where
// there are too many.
bool PackedCollapse::gather(uint32_t vertex, PackedRing& ring) const {
    if (mesh_.valence(vertex) > PackedRing::most) return false;
    uint32_t count = 0;
    for (uint32_t s = mesh_.first_spoke[vertex]; s < mesh_.first_spoke[vertex + 1]; ++s) {
        const uint32_t next = now(mesh_.spokes[s].next), previous = now(mesh_.spokes[s].previous);
        ring.next[count] = next, ring.previous[count] = previous, ring.spoke[count] = s;
        ring.neighbours[count] = next;
        count += next != previous && next != vertex && previous != vertex ? 1 : 0;
    }
    ring.count = ring.neighbour_count = count;
    if (mesh_.kinds[vertex] == VertexKind::manifold || mesh_.kinds[vertex] == VertexKind::seam) return true;
    const uint32_t* nexts_end = ring.next.data() + count;
    for (uint32_t i = 0; i < count; ++i)
        if (std::find(std::as_const(ring.next).data(), nexts_end, ring.previous[i]) == nexts_end)
            ring.neighbours[ring.neighbour_count++] = ring.previous[i];
    return true;
}

// And adds to the volume below the surface, six times, what is below these triangles. The vertex that stays
// is the origin, so those that go, which both ends see, count once.
void PackedCollapse::gather_fan(uint32_t vertex, uint32_t other, Vec3f origin, const PackedRing& ring,
                                PackedFan& fan) {
    fan.begin(mesh_.positions[vertex] - origin);
    for (uint32_t i = 0; i < ring.count; ++i) {
        const uint32_t next = ring.next[i], previous = ring.previous[i];
        const Vec3f a = mesh_.positions[next] - origin, b = mesh_.positions[previous] - origin;
        if (next == other || previous == other) {
            volume_.offset += dot(fan.tip, cross(a, b));
        } else {
            fan.add(ring, i, {a, b}, facing_[next] + facing_[previous]);
        }
    }
    const Vec3f outer = fan.outer();
    volume_.normal = volume_.normal + outer;
    volume_.offset += dot(fan.tip, outer);
}

// The corners opposite to the edge keep a triangle.
bool PackedCollapse::leaves_none_out(const Merge& m) const {
    if (mesh_.kinds[m.removed] == VertexKind::manifold) return true;
    for (uint32_t i = 0; i < removed_ring_.count; ++i) {
        const uint32_t next = removed_ring_.next[i], previous = removed_ring_.previous[i];
        if (next != m.kept && previous != m.kept) continue;
        const uint32_t opposite = next == m.kept ? previous : next;
        if (!removed_fan_.holds(opposite) && !kept_fan_.holds(opposite)) return false;
    }
    return true;
}

std::optional<Vec3f> PackedCollapse::place(const Merge& m, const CentredQuadric& planes, Vec3f offset) {
    const auto is_sound = [&](Vec3f at) {
        if (m.moves && !is_in_box(mesh_.positions[m.kept] + at)) return false;
        const Vec3f removed = facing_[m.removed], kept = facing_[m.kept];
        const Vec3f facing = m.moves ? normalized(removed + kept) : kept;
        return keeps_orientation(removed_fan_, removed, facing, at) &&
               (!m.moves || keeps_orientation(kept_fan_, kept, facing, at)) && keeps_texture(m, at);
    };
    if (!m.moves) return is_sound({}) ? std::optional(Vec3f{}) : std::nullopt;
    CentredQuadric q = planes;
    for (uint32_t i = 0; i < pair_count_; ++i) q += attributes_.error(pairs_[i]);
    const bool is_inside = mesh_.kinds[m.kept] == VertexKind::manifold;
    const Vec3f best = least_point(q, offset, is_inside ? &volume_ : nullptr);
    if (is_sound(best)) return best;
    const Vec3f end = best_of_edge(q, offset);
    return is_sound(end) ? std::optional(end) : std::nullopt;
}

// Whose sides each have a vertex that stays.
bool PackedCollapse::is_in_box(Vec3f point) const {
    const Vec3f half = mesh_.half_box;
    return std::abs(point.x) <= half.x + box_tolerance && std::abs(point.y) <= half.y + box_tolerance &&
           std::abs(point.z) <= half.z + box_tolerance;
}

// No triangle of the texture is mirrored.
bool PackedCollapse::keeps_texture(const Merge& m, Vec3f at) const {
    if (attributes_.uv_sets() == 0) return true;
    const auto area = [](const std::array<float, 2>& a, const std::array<float, 2>& b,
                         const std::array<float, 2>& c) {
        return (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]);
    };
    const auto keeps = [&](const PackedFan& fan, uint32_t vertex, uint32_t WedgeQuadrics::Pair::*end) {
        for (uint32_t i = 0; i < fan.count; ++i) {
            const auto wedges = mesh_.wedges(vertex, fan.spoke[i]);
            const uint32_t own = wedge_now(wedges[0]), next = wedge_now(wedges[1]),
                           previous = wedge_now(wedges[2]);
            const auto pair = std::find_if(pairs_.begin(), pairs_.begin() + pair_count_,
                                           [&](const auto& p) { return p.*end == own; });
            if (pair == pairs_.begin() + pair_count_) continue;  // another wedge of the vertex that stays
            for (uint32_t set = 0; set < attributes_.uv_sets(); ++set) {
                const auto ahead = attributes_.uv(next, set), behind = attributes_.uv(previous, set);
                const float before = area(attributes_.uv(own, set), ahead, behind);
                const float after =
                    area(m.moves ? attributes_.uv(*pair, at, set) : attributes_.uv(pair->kept, set), ahead,
                         behind);
                if (before > 0 ? !(after > 0) : before < 0 && !(after < 0)) return false;
            }
        }
        return true;
    };
    return keeps(removed_fan_, m.removed, &WedgeQuadrics::Pair::removed) &&
           (!m.moves || keeps(kept_fan_, m.kept, &WedgeQuadrics::Pair::kept));
}

// The other neighbour of a vertex along its line; no_index where there is none.
uint32_t PackedCollapse::line_neighbour(uint32_t vertex, uint32_t but) const {
    const uint32_t begin = mesh_.first_spoke[vertex], end = mesh_.first_spoke[vertex + 1];
    const bool is_border = mesh_.kinds[vertex] == VertexKind::border;
    const auto own = [&](uint32_t spoke) { return wedge_now(mesh_.wedges(vertex, spoke)[0]); };
    const auto other_end = [&](uint32_t spoke, bool next) {
        return now(next ? mesh_.spokes[spoke].next : mesh_.spokes[spoke].previous);
    };
    for (uint32_t s = begin; s < end; ++s) {
        if (other_end(s, true) == other_end(s, false)) continue;  // gone in this pass
        for (const bool ahead : {true, false}) {
            const uint32_t neighbour = other_end(s, ahead);
            if (neighbour == but || neighbour == vertex) continue;
            bool is_paired = false;
            for (uint32_t t = begin; t < end && !is_paired; ++t)
                is_paired = other_end(t, !ahead) == neighbour && other_end(t, ahead) != neighbour &&
                            (is_border || own(t) == own(s));
            if (!is_paired) return neighbour;
        }
    }
    return no_index;
}

// How far the line may be from where it was; none where that is too far.
std::optional<float> PackedCollapse::line_away(const Merge& m, Vec3f at) const {
    const uint32_t before = line_neighbour(m.removed, m.kept);
    if (before == no_index) return {};
    const uint32_t after = m.moves ? line_neighbour(m.kept, m.removed) : no_index;
    if (after == before) return {};  // all that is left of a loop
    for (uint32_t i = 0; i < removed_ring_.count; ++i) {
        const uint32_t next = removed_ring_.next[i], previous = removed_ring_.previous[i];
        if ((next == m.kept && previous == before) || (previous == m.kept && next == before)) return {};
    }
    const Vec3f removed = mesh_.positions[m.removed], kept = mesh_.positions[m.kept], point = kept + at;
    const auto from_line = [&](Vec3f p) {
        float distance = distance_to_segment(p, mesh_.positions[before], point);
        if (after != no_index)
            distance = std::min(distance, distance_to_segment(p, point, mesh_.positions[after]));
        return distance;
    };
    const float carried =
        std::max({away_[m.removed], away_[m.kept], away_[before], away_[after == no_index ? before : after]});
    const float away = carried + std::max(from_line(removed), from_line(kept));
    return away <= line_tolerance ? std::optional(away) : std::nullopt;
}

void PackedCollapse::apply(const Merge& m, Vec3f at, const CentredQuadric& planes, Vec3f offset) {
    if (blends_values_) {
        const float squared = squared_length(offset);
        const double share =
            squared > 0 ? std::clamp(double{dot(at, offset)} / double{squared}, 0.0, 1.0) : 0;
        const auto blend = [&](uint32_t removed, uint32_t kept) {
            const std::array<WedgeShare, 2> shares = {
                {{wedge_origin_[kept], 1 - share}, {wedge_origin_[removed], share}}};
            values_.blend(shares, wedge_origin_[kept]);
        };
        if (m.moves && pair_count_ == 0) blend(m.removed, m.kept);
        for (uint32_t i = 0; m.moves && i < pair_count_; ++i) blend(pairs_[i].removed, pairs_[i].kept);
    }
    for (uint32_t i = 0; i < pair_count_; ++i) {
        if (i == 1 && pairs_[1].kept == pairs_[0].kept && attributes_.any())
            attributes_.join(offset, pairs_[1]);  // the first merge has changed it; a seam ends here
        if (attributes_.any()) attributes_.merge(pairs_[i], at, !m.moves);
        if (mesh_.has_wedges()) wedge_becomes_[pairs_[i].removed] = pairs_[i].kept;
    }
    planes_[m.kept] = planes.seen_from(at * -1);
    if (m.moves) {
        mesh_.positions[m.kept] = mesh_.positions[m.kept] + at;
        facing_[m.kept] = normalized(facing_[m.removed] + facing_[m.kept]);
        moved_[m.kept] = true;
    }
    vertex_becomes_[m.removed] = m.kept;
    changed_[m.kept] = 1;
}

double PackedCollapse::error_model_units() const {
    return double{largest_error_} * mesh_.diagonal;
}

Mesh PackedCollapse::extract(const Watch& watch) const {
    Mesh mesh = without_geometry(source_);
    const bool any_moved = std::find(moved_.begin(), moved_.end(), true) != moved_.end();
    if (any_moved) mesh.position_storage = {};
    mesh.positions.reserve(mesh_.vertex_count());
    watched_loop(mesh_.vertex_count(), watch, [&](size_t v) {
        mesh.positions.push_back(moved_[v]
                                     ? to_float(to_double(mesh_.positions[v]) * mesh_.diagonal + mesh_.centre)
                                     : source_.positions[mesh_.vertex_source[v]]);
    });
    mesh.triangles = watched_copy(mesh_.has_wedges() ? mesh_.corner_wedges : mesh_.triangles, watch);
    mesh.triangle_slot = watched_copy(mesh_.triangle_slot, watch);
    mesh.wedge_vertex.resize(mesh_.wedge_count());
    watched_loop(mesh.triangles.size(), watch,
                 [&](size_t corner) { mesh.wedge_vertex[mesh.triangles[corner]] = mesh_.triangles[corner]; });
    values_.write(wedge_origin_, mesh);
    attributes_.write(mesh);
    drop_unused(mesh, watch);
    return mesh;
}

}  // namespace coppice
