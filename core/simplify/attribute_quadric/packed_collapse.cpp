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
#include "core/simplify/line_guard.h"

namespace coppice {

namespace {

// Of the planes' weight. Enough to keep flat regions well shaped, too little to be seen elsewhere.
constexpr float stiffness = 1e-4F;
constexpr double border_weight = 10, seam_weight = 1;  // of the plane across a line, times its edge squared
constexpr float least_cosine_at_once = 0.25F, least_cosine_to_facing = 0.25F;
constexpr float degenerate_aspect = 1e-6F;  // as in collapse_rules.cpp
constexpr float no_cost = -1;
// A pass takes nothing that costs more than this times what the last edge would that it needs.
constexpr float patience = 1.5F;
constexpr auto box_tolerance = static_cast<float>(packed_tolerance * bounds_tolerance_of_diagonal);
constexpr auto line_tolerance = static_cast<float>(packed_tolerance * line_tolerance_of_diagonal);

bool is_degenerate(Vec3f a, Vec3f b, Vec3f c, Vec3f normal) {
    const float longest = std::max({squared_length(b - a), squared_length(c - b), squared_length(a - c)});
    return squared_length(normal) <= degenerate_aspect * degenerate_aspect * longest * longest;
}

float distance_to_segment(Vec3f p, Vec3f a, Vec3f b) {
    const Vec3f edge = b - a;
    const float squared = squared_length(edge);
    const float along = squared > 0 ? std::clamp(dot(p - a, edge) / squared, 0.0F, 1.0F) : 0.0F;
    return length(p - (a + edge * along));
}

bool has_other_values(const Mesh& mesh) {
    const auto has_quadric = [](const Attribute& a) {
        return a.name == "NORMAL" || a.name.starts_with("TEXCOORD_") || a.name.starts_with("COLOR_");
    };
    return !mesh.morph_targets.empty() ||
           !std::all_of(mesh.attributes.begin(), mesh.attributes.end(), has_quadric);
}

}  // namespace

PackedCollapse::PackedCollapse(const Mesh& source, const PackedOptions& options, const Watch& watch)
    : source_(source),
      options_(options),
      mesh_(source, watch),
      attributes_(mesh_, source, options.weights, watch),
      first_wedges_(mesh_.wedge_source),
      values_(source, first_wedges_),
      blends_values_(has_other_values(source)) {
    wedge_origin_.resize(mesh_.wedge_count());
    std::iota(wedge_origin_.begin(), wedge_origin_.end(), 0U);
    away_.resize(mesh_.vertex_count());
    moved_.resize(mesh_.vertex_count());
    changed_.assign(mesh_.vertex_count(), 1);
    costs_.resize(mesh_.triangles.size());
    if (options_.lock_borders)
        std::replace(mesh_.kinds.begin(), mesh_.kinds.end(), VertexKind::border, VertexKind::corner);
    add_planes(watch);
    add_lines(watch);
}

// A triangle's plane passes through its corners, so about each of them it has no offset.
void PackedCollapse::add_planes(const Watch& watch) {
    watched_resize(planes_, mesh_.vertex_count(), watch);
    watched_resize(facing_, mesh_.vertex_count(), watch);
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
        for (size_t k = 0; k < 3; ++k) {
            planes_[v[k]] += q;
            facing_[v[k]] = facing_[v[k]] + area;
        }
    });
    watched_loop(facing_.size(), watch, [&](size_t v) { facing_[v] = normalized(facing_[v]); });
}

// Across borders and seams: through the edge, perpendicular to its triangle.
void PackedCollapse::add_lines(const Watch& watch) {
    watched_loop(mesh_.vertex_count(), watch, [&](size_t i) {
        const auto v = static_cast<uint32_t>(i);
        if (mesh_.kinds[v] == VertexKind::manifold) return;
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
    if (a == complex || b == complex) return {};
    if (a == manifold || b == manifold) {
        if (next < vertex) return {};
        if (a == b) return Merge{next, vertex, true};
        return a == manifold ? Merge{vertex, next, false} : Merge{next, vertex, false};
    }
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
    if (a == VertexKind::corner && b == line) return Merge{next, vertex, false};
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
        if (pair_count_ > 0 && pairs_[0].removed == removed && pairs_[0].kept == kept) continue;
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

std::optional<Vec3f> PackedCollapse::best_point(const CentredQuadric& q, Vec3f offset,
                                                const Constraint& keep) const {
    const Vec3f middle = offset * 0.5F;
    const std::optional<Vec3f> point = least_point(q, stiffness * q.weight, middle, keep);
    // Nearly parallel planes meet anywhere.
    if (!point || squared_length(*point - middle) > 4 * squared_length(offset)) return {};
    return point;
}

Vec3f PackedCollapse::best_of_edge(const CentredQuadric& q, Vec3f offset) const {
    const Vec3f middle = offset * 0.5F;
    const float at_kept = q({}), at_removed = q(offset), at_middle = q(middle);
    if (at_middle <= at_kept && at_middle <= at_removed) return middle;
    return at_kept <= at_removed ? Vec3f{} : offset;
}

float PackedCollapse::cost(const Merge& m) {
    const Vec3f offset = mesh_.positions[m.removed] - mesh_.positions[m.kept];
    CentredQuadric q = planes_of(m, offset);
    if (attributes_.any()) find_pairs(m);
    if (!m.moves) {
        float sum = q.c;
        for (uint32_t i = 0; i < pair_count_; ++i) sum += attributes_.error_with_values_kept(pairs_[i], {});
        return std::max(0.0F, sum);
    }
    for (uint32_t i = 0; i < pair_count_; ++i) q += attributes_.error(pairs_[i]);
    const std::optional<Vec3f> point = best_point(q, offset, {});
    return q(point ? *point : best_of_edge(q, offset));
}

// What none of whose ends has changed costs what it did.
void PackedCollapse::rank(const Watch& watch) {
    order_.clear();
    watched_loop(mesh_.triangle_count(), watch, [&](size_t t) {
        const auto first = static_cast<uint32_t>(3 * t);
        for (uint32_t corner = first; corner < first + 3; ++corner) {
            const uint32_t ahead = corner == first + 2 ? first : corner + 1;
            if ((changed_[mesh_.triangles[corner]] | changed_[mesh_.triangles[ahead]]) != 0) {
                const std::optional<Merge> merge = merge_along(corner);
                costs_[corner] = merge ? cost(*merge) : no_cost;
            }
            if (costs_[corner] >= 0) order_.push_back(corner);
        }
    });
    // By the upper bits of the cost, two digits of 9: what is a quarter of one percent apart is equal.
    const auto key = [this](uint32_t corner) { return std::bit_cast<uint32_t>(costs_[corner]) >> 14; };
    sorted_.resize(order_.size());
    for (const uint32_t shift : {0U, 9U}) {
        std::array<uint32_t, 513> begin{};
        for (const uint32_t corner : order_) ++begin[(key(corner) >> shift & 511U) + 1];
        std::partial_sum(begin.begin(), begin.end(), begin.begin());
        for (const uint32_t corner : order_) sorted_[begin[key(corner) >> shift & 511U]++] = corner;
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
    const double limit = target.error_model_units && mesh_.diagonal > 0
                             ? *target.error_model_units / mesh_.diagonal
                             : std::numeric_limits<float>::infinity();
    const double start = mesh_.triangle_count();
    while (!is_met(target)) {
        if (pass(to_go(target), static_cast<float>(limit * limit), watch) == 0) return;
        const auto goal = static_cast<double>(target.triangles.value_or(0));
        watch.report(std::min(1.0, (start - mesh_.triangle_count()) / std::max(1.0, start - goal)));
    }
}

uint64_t PackedCollapse::pass(const ToGo& to_go, float squared_limit, const Watch& watch) {
    vertex_becomes_.resize(mesh_.vertex_count());
    std::iota(vertex_becomes_.begin(), vertex_becomes_.end(), 0U);
    wedge_becomes_.resize(mesh_.has_wedges() ? mesh_.wedge_count() : 0);
    std::iota(wedge_becomes_.begin(), wedge_becomes_.end(), 0U);
    rank(watch);
    if (order_.empty()) return 0;
    changed_.assign(mesh_.vertex_count(), 0);

    const uint64_t collapses = std::min(to_go.triangles / 2, to_go.vertices);
    const auto wanted = static_cast<size_t>(static_cast<double>(collapses) * options_.share_of_pass);
    const float dearest = costs_[order_[std::min(order_.size() - 1, wanted)]] * patience;
    uint64_t triangles = 0, vertices = 0;
    size_t step = 0;
    for (const uint32_t corner : order_) {
        if (triangles >= to_go.triangles || vertices >= to_go.vertices) break;
        if (costs_[corner] > dearest && triangles > to_go.triangles / 10) break;
        const Merge merge = *merge_along(corner);
        if (is_taken(merge.removed) || is_taken(merge.kept)) continue;
        if (++step % 4096 == 0) watch.check();
        const uint32_t gone = try_collapse(merge, squared_limit);
        triangles += gone;
        vertices += gone > 0 ? 1 : 0;
    }
    if (triangles > 0) pack(watch);
    return triangles;
}

void PackedCollapse::pack(const Watch& watch) {
    const Renumbering numbers =
        mesh_.compact(vertex_becomes_, mesh_.has_wedges() ? wedge_becomes_ : vertex_becomes_, watch);
    renumber(planes_, numbers.vertices, numbers.vertices_left);
    renumber(facing_, numbers.vertices, numbers.vertices_left);
    renumber(away_, numbers.vertices, numbers.vertices_left);
    renumber(moved_, numbers.vertices, numbers.vertices_left);
    renumber(wedge_origin_, numbers.wedges, numbers.wedges_left);
    renumber(changed_, numbers.vertices, numbers.vertices_left);
    renumber(costs_, numbers.triangles, numbers.triangles_left, 3);
    attributes_.renumber_wedges(numbers);
}

// Triangles that went; none where a rule is broken.
uint32_t PackedCollapse::try_collapse(const Merge& m, float squared_limit) {
    if (!gather(m.removed, removed_ring_) || !gather(m.kept, kept_ring_)) return 0;
    if (!has_sound_link(m) || !gather_leaves(m)) return 0;
    const Vec3f offset = mesh_.positions[m.removed] - mesh_.positions[m.kept];
    const CentredQuadric planes = planes_of(m, offset);
    find_pairs(m);
    const std::optional<Vec3f> at = place(m, planes, offset);
    if (!at) return 0;
    const float squared_error = planes.weight > 0 ? planes(*at) / planes.weight : 0;
    if (squared_error > squared_limit) {
        met_error_limit_ = true;
        return 0;
    }
    if (mesh_.kinds[m.removed] != VertexKind::manifold) {
        const std::optional<float> away = line_away(m, *at);
        if (!away) return 0;
        away_[m.kept] = *away;
    }
    squared_error_ = std::max(squared_error_, squared_error);
    apply(m, *at, planes, offset);
    return dying_;
}

// Around the inside of a chart each neighbour comes next once; elsewhere some are only previous. False where
// there are too many.
bool PackedCollapse::gather(uint32_t vertex, Ring& ring) const {
    if (mesh_.valence(vertex) > Ring::most) return false;
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

// The ends have no neighbours in common but the corners opposite to their edge (Dey and others 1999), and no
// two triangles come to lie on each other.
bool PackedCollapse::has_sound_link(const Merge& m) const {
    const Ring &r = removed_ring_, &k = kept_ring_;
    std::array<uint32_t, 2> opposite = {no_index, no_index};
    uint32_t at_edge = 0;
    for (uint32_t i = 0; i < r.count; ++i) {
        if (r.next[i] != m.kept && r.previous[i] != m.kept) continue;
        if (at_edge == 2) return false;
        opposite[at_edge++] = r.next[i] == m.kept ? r.previous[i] : r.next[i];
    }
    uint32_t shared = 0;
    for (uint32_t i = 0; i < r.neighbour_count; ++i) {
        const uint32_t* end = k.neighbours.data() + k.neighbour_count;
        shared += std::find(k.neighbours.data(), end, r.neighbours[i]) != end ? 1 : 0;
    }
    if (at_edge == 0 || shared != at_edge) return false;
    const auto closes = [&opposite](const Ring& ring) {
        for (uint32_t i = 0; i < ring.count; ++i) {
            if ((ring.next[i] == opposite[0] && ring.previous[i] == opposite[1]) ||
                (ring.next[i] == opposite[1] && ring.previous[i] == opposite[0])) {
                return true;
            }
        }
        return false;
    };
    return !closes(r) || !closes(k);
}

// False where something would be left without a triangle.
bool PackedCollapse::gather_leaves(const Merge& m) {
    leaves_.clear();
    dying_ = 0;
    volume_ = {};
    std::array<uint32_t, 2> opposite = {};
    const Vec3f origin = mesh_.positions[m.kept];
    for (const bool of_removed : {true, false}) {
        const Ring& ring = of_removed ? removed_ring_ : kept_ring_;
        const uint32_t other = of_removed ? m.kept : m.removed;
        const Vec3f here = of_removed ? mesh_.positions[m.removed] - origin : Vec3f{};
        for (uint32_t i = 0; i < ring.count; ++i) {
            const uint32_t next = ring.next[i], previous = ring.previous[i];
            const bool dies = next == other || previous == other;
            if (dies && !of_removed) continue;
            const Vec3f a = mesh_.positions[next] - origin, b = mesh_.positions[previous] - origin;
            const Vec3f outer = cross(a, b);
            volume_.offset += dot(here, outer);
            if (dies) {
                opposite[dying_++] = next == other ? previous : next;
                continue;
            }
            volume_.normal = volume_.normal + outer;
            leaves_.push_back({a, b, cross(a - here, b - here), next, previous, ring.spoke[i], of_removed});
        }
    }
    if (mesh_.kinds[m.removed] == VertexKind::manifold) return true;
    return std::all_of(opposite.begin(), opposite.begin() + dying_, [&](uint32_t vertex) {
        return std::any_of(leaves_.begin(), leaves_.end(),
                           [&](const Leaf& leaf) { return leaf.next == vertex || leaf.previous == vertex; });
    });
}

std::optional<Vec3f> PackedCollapse::place(const Merge& m, const CentredQuadric& planes, Vec3f offset) {
    const auto is_sound = [&](Vec3f at) {
        if (m.moves && !is_in_box(mesh_.positions[m.kept] + at)) return false;
        return keeps_orientation(m, at) && keeps_texture(m, at);
    };
    if (!m.moves) return is_sound({}) ? std::optional(Vec3f{}) : std::nullopt;
    CentredQuadric q = planes;
    for (uint32_t i = 0; i < pair_count_; ++i) q += attributes_.error(pairs_[i]);
    const bool is_inside = mesh_.kinds[m.kept] == VertexKind::manifold;
    const std::optional<Vec3f> best = best_point(q, offset, is_inside ? volume_ : Constraint{});
    if (best && is_sound(*best)) return best;
    const Vec3f end = best_of_edge(q, offset);
    return is_sound(end) ? std::optional(end) : std::nullopt;
}

// Whose sides each have a vertex that stays.
bool PackedCollapse::is_in_box(Vec3f point) const {
    const Vec3f half = mesh_.half_box;
    return std::abs(point.x) <= half.x + box_tolerance && std::abs(point.y) <= half.y + box_tolerance &&
           std::abs(point.z) <= half.z + box_tolerance;
}

// No triangle turns by more than about 75 degrees, now or away from where the surface faced at its corners at
// the start; none becomes degenerate. Cosines are compared as squares.
bool PackedCollapse::keeps_orientation(const Merge& m, Vec3f at) const {
    const Vec3f here = m.moves ? normalized(facing_[m.removed] + facing_[m.kept]) : facing_[m.kept];
    const Vec3f offset = mesh_.positions[m.removed] - mesh_.positions[m.kept];
    const auto is_less = [](float cosine_times, float least_cosine, float squared) {
        return cosine_times < 0 || cosine_times * cosine_times < least_cosine * least_cosine * squared;
    };
    for (const Leaf& leaf : leaves_) {
        if (!leaf.of_removed && !m.moves) break;
        const Vec3f normal = cross(leaf.ahead - at, leaf.behind - at);
        const Vec3f others = facing_[leaf.next] + facing_[leaf.previous];
        const float squared = squared_length(normal), squared_before = squared_length(leaf.normal);
        const bool turns = is_less(dot(normal, leaf.normal), least_cosine_at_once, squared * squared_before);
        const bool faces_away = is_less(dot(here + others, normal), 3 * least_cosine_to_facing, squared);
        const bool is_flat = is_degenerate(at, leaf.ahead, leaf.behind, normal);
        if (!turns && !faces_away && !is_flat) continue;
        const bool was_degenerate =
            is_degenerate(leaf.of_removed ? offset : Vec3f{}, leaf.ahead, leaf.behind, leaf.normal);
        if (is_flat && was_degenerate) continue;
        if (is_flat || (turns && !was_degenerate) || (faces_away && was_degenerate)) return false;
        if (!faces_away) continue;
        // Where it faced away before, it may as long as that is no worse.
        const Vec3f own = facing_[leaf.of_removed ? m.removed : m.kept];
        if (dot(here + others, normal) * std::sqrt(squared_before) <
            dot(own + others, leaf.normal) * std::sqrt(squared)) {
            return false;
        }
    }
    return true;
}

// No triangle of the texture is mirrored.
bool PackedCollapse::keeps_texture(const Merge& m, Vec3f at) const {
    if (attributes_.uv_sets() == 0) return true;
    const auto area = [](const std::array<float, 2>& a, const std::array<float, 2>& b,
                         const std::array<float, 2>& c) {
        return (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]);
    };
    for (const Leaf& leaf : leaves_) {
        if (!leaf.of_removed && !m.moves) continue;
        const auto wedges = mesh_.wedges(leaf.of_removed ? m.removed : m.kept, leaf.spoke);
        const uint32_t own = wedge_now(wedges[0]), next = wedge_now(wedges[1]),
                       previous = wedge_now(wedges[2]);
        const auto is_of_leaf = [&](const WedgeQuadrics::Pair& pair) {
            return (leaf.of_removed ? pair.removed : pair.kept) == own;
        };
        const auto end = pairs_.begin() + pair_count_;
        const auto pair = std::find_if(pairs_.begin(), end, is_of_leaf);
        if (pair == end) continue;  // another wedge of the vertex that stays
        for (uint32_t set = 0; set < attributes_.uv_sets(); ++set) {
            const auto ahead = attributes_.uv(next, set), behind = attributes_.uv(previous, set);
            const float before = area(attributes_.uv(own, set), ahead, behind);
            const float after = area(
                m.moves ? attributes_.uv(*pair, at, set) : attributes_.uv(pair->kept, set), ahead, behind);
            if (before != 0 && !(before * after > 0)) return false;
        }
    }
    return true;
}

// The other neighbour of a vertex along its line.
std::optional<uint32_t> PackedCollapse::line_neighbour(uint32_t vertex, uint32_t but) const {
    const uint32_t begin = mesh_.first_spoke[vertex], end = mesh_.first_spoke[vertex + 1];
    const bool is_border = mesh_.kinds[vertex] == VertexKind::border;
    const auto own = [&](uint32_t spoke) { return wedge_now(mesh_.wedges(vertex, spoke)[0]); };
    for (uint32_t s = begin; s < end; ++s) {
        for (const bool ahead : {true, false}) {
            const auto other_end = [&](uint32_t spoke, bool next) {
                return now(next ? mesh_.spokes[spoke].next : mesh_.spokes[spoke].previous);
            };
            const uint32_t neighbour = other_end(s, ahead);
            if (neighbour == but || neighbour == vertex) continue;
            bool is_paired = false;
            for (uint32_t t = begin; t < end && !is_paired; ++t)
                is_paired = other_end(t, !ahead) == neighbour && (is_border || own(t) == own(s));
            if (!is_paired) return neighbour;
        }
    }
    return {};
}

// How far the line may be from where it was; none where that is too far.
std::optional<float> PackedCollapse::line_away(const Merge& m, Vec3f at) const {
    const std::optional<uint32_t> before = line_neighbour(m.removed, m.kept);
    if (!before) return {};
    std::optional<uint32_t> after;
    if (m.moves) after = line_neighbour(m.kept, m.removed);
    if (after && *after == *before) return {};  // all that is left of a loop
    const Vec3f removed = mesh_.positions[m.removed], kept = mesh_.positions[m.kept], point = kept + at;
    const auto from_line = [&](Vec3f p) {
        float distance = distance_to_segment(p, mesh_.positions[*before], point);
        if (after) distance = std::min(distance, distance_to_segment(p, point, mesh_.positions[*after]));
        return distance;
    };
    const float away =
        std::max(away_[m.removed], away_[m.kept]) + std::max(from_line(removed), from_line(kept));
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
    return std::sqrt(double{squared_error_}) * mesh_.diagonal;
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
