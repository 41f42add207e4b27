#include "core/simplify/star_contraction.h"

#include <algorithm>
#include <cassert>

namespace coppice {

StarContraction::StarContraction(const Mesh& source, const Target& target, const Watch& watch)
    : GuardedMesh(source, target, {}, watch),
      values_(source, mesh_.wedge_sources()),
      groups_(mesh_),
      marks_(watched_vector<Mark>(mesh_.vertex_count(), watch)) {}

bool StarContraction::kinds_allow(std::span<const uint32_t> vertices) const {
    uint32_t corners = 0, seams = 0, borders = 0;
    for (const uint32_t v : vertices) {
        const VertexKind kind = features_.kinds[v];
        if (kind == VertexKind::complex || mesh_.valence(v) > largest_removable_valence) return false;
        corners += kind == VertexKind::corner;
        seams += kind == VertexKind::seam;
        borders += kind == VertexKind::border;
    }
    return corners + seams <= 1 && (seams == 0 || borders == 0);
}

uint32_t StarContraction::triangles_saved(std::span<const uint32_t> vertices) const {
    const auto borders =
        static_cast<uint32_t>(std::count_if(vertices.begin(), vertices.end(), [this](uint32_t v) {
            return features_.kinds[v] == VertexKind::border;
        }));
    return 2 * (static_cast<uint32_t>(vertices.size()) - 1) - (borders > 1 ? borders - 1 : 0);
}

Refusal StarContraction::try_contract(std::span<const uint32_t> vertices, const Placement& placement) {
    assert(vertices.size() > 1 && vertices.size() == placement.weights.size());
    const Refusal refusal = check(vertices, placement);
    if (refusal == Refusal::none) {
        contract(vertices);
    } else {
        refusals_.add(refusal);
    }
    return refusal;
}

Refusal StarContraction::check(std::span<const uint32_t> vertices, const Placement& placement) {
    if (!kinds_allow(vertices)) return Refusal::locked;
    if (!place(vertices, placement)) return Refusal::topology;
    if (!gather_star(vertices) || !has_sound_link(vertices.size())) return Refusal::topology;
    if (!bounds_.may_merge(vertices, point_)) return Refusal::bounds;
    const Vec3f facing = mean_facing(vertices);
    for (const uint32_t c : fan_) {
        if (!stays(c) && !rules_.keeps_orientation(c, point_, facing)) return Refusal::topology;
    }
    if (!groups_.find(vertices, weights_, anchors_ > 0 ? kept_ : no_index, gone_)) return Refusal::locked;
    if (uvs_.any()) {
        for (const uint32_t c : fan_)
            if (!uvs_.may_blend(c, groups_.shares(mesh_.corner_wedge(c)))) return Refusal::topology;
    }
    next_deviation_ = deviation(vertices);
    return check_deviation(next_deviation_);
}

// Seams and corners stay; a set that reaches a border goes to it.
bool StarContraction::place(std::span<const uint32_t> vertices, const Placement& placement) {
    borders_ = anchors_ = 0;
    kept_ = vertices.front();
    for (const uint32_t v : vertices) {
        const VertexKind kind = features_.kinds[v];
        if (kind == VertexKind::corner || kind == VertexKind::seam) ++anchors_;
        if (kind == VertexKind::border) ++borders_;
    }
    point_ = placement.point;
    weights_.assign(placement.weights.begin(), placement.weights.end());
    moves_nothing_ = anchors_ + borders_ > 0 && (anchors_ == 1 || borders_ != 2);
    if (anchors_ + borders_ == 0) return true;

    const auto on_line = [this](uint32_t v) {
        return anchors_ > 0
                   ? features_.kinds[v] == VertexKind::corner || features_.kinds[v] == VertexKind::seam
                   : features_.kinds[v] == VertexKind::border;
    };
    kept_ = *std::min_element(vertices.begin(), vertices.end(), [&](uint32_t a, uint32_t b) {
        if (on_line(a) != on_line(b)) return on_line(a);
        return squared_length(mesh_.position(a) - placement.point) <
               squared_length(mesh_.position(b) - placement.point);
    });
    Vec3d sum;
    for (size_t i = 0; i < vertices.size(); ++i) {
        const bool counts = moves_nothing_ ? vertices[i] == kept_ : on_line(vertices[i]);
        weights_[i] = counts ? (moves_nothing_ ? 1 : 0.5) : 0;
        sum = sum + mesh_.position(vertices[i]) * weights_[i];
    }
    point_ = sum;
    return !changes_line() || lines_.may_merge(vertices, point_);
}

// False where it is too large to be looked at.
bool StarContraction::gather_star(std::span<const uint32_t> vertices) {
    if (++round_ == 0) {  // after 2^32 rounds
        marks_.assign(marks_.size(), Mark{});
        round_ = 1;
    }
    fan_.clear();
    gone_.clear();
    for (const uint32_t v : vertices) marks_[v].in_set = round_;
    const auto is_in = [this](uint32_t corner) {
        return marks_[mesh_.corner_vertex(corner)].in_set == round_;
    };
    for (const uint32_t v : vertices) {
        for (uint32_t c = mesh_.first_corner(v); c != no_index; c = mesh_.corner_after(c)) {
            const uint32_t next = CollapseMesh::next_corner(c), previous = CollapseMesh::previous_corner(c);
            const bool next_in = is_in(next), previous_in = is_in(previous);
            if (!next_in && !previous_in) {
                fan_.push_back(c);
            } else if ((!next_in || c < next) && (!previous_in || c < previous)) {
                gone_.push_back(c / 3);
            }
        }
    }
    return fan_.size() <= 2 * largest_removable_valence;
}

// One simple cycle or path, and as many triangles inside as a disc has.
bool StarContraction::has_sound_link(size_t set_size) {
    if (fan_.empty()) return false;
    for (const uint32_t c : fan_) {
        const uint32_t a = mesh_.corner_vertex(CollapseMesh::next_corner(c));
        const uint32_t b = mesh_.corner_vertex(CollapseMesh::previous_corner(c));
        if (marks_[a].starts == round_ || marks_[b].ends == round_) return false;
        marks_[a].starts = marks_[b].ends = round_;
        marks_[a].next = b;
    }
    uint32_t first = mesh_.corner_vertex(CollapseMesh::next_corner(fan_.front()));
    bool closed = true;
    for (const uint32_t c : fan_) {
        const uint32_t a = mesh_.corner_vertex(CollapseMesh::next_corner(c));
        if (marks_[a].ends == round_) continue;
        if (!closed) return false;  // several paths
        closed = false;
        first = a;
    }
    size_t steps = 0;
    uint32_t at = first;
    do {
        at = marks_[at].next;
        ++steps;
    } while (at != first && marks_[at].starts == round_);
    if (steps != fan_.size()) return false;
    const size_t inside = 2 * (set_size - 1);
    if (closed) return steps >= 3 && borders_ == 0 && gone_.size() == inside;
    const size_t on_border = borders_ + anchors_;
    return on_border > 0 && gone_.size() == inside - (on_border - 1);
}

Vec3f StarContraction::mean_facing(std::span<const uint32_t> vertices) const {
    if (moves_nothing_) return rules_.facing(kept_);
    Vec3d sum;
    for (const uint32_t v : vertices) sum = sum + to_double(rules_.facing(v));
    return to_float(normalized(sum));
}

// As Deviation::after: each vertex to the triangles that take the place of its own.
double StarContraction::deviation(std::span<const uint32_t> vertices) const {
    double largest = 0;
    size_t begin = 0;
    for (const uint32_t v : vertices) {
        size_t end = begin;
        while (end < fan_.size() && mesh_.corner_vertex(fan_[end]) == v) ++end;
        const Vec3d p = mesh_.position(v);
        double distance = length(p - point_);
        const bool inner = begin == end;  // its triangles are all gone
        for (size_t i = inner ? 0 : begin; i < (inner ? fan_.size() : end) && distance > 0; ++i) {
            const Vec3d a = mesh_.position(mesh_.corner_vertex(CollapseMesh::next_corner(fan_[i])));
            const Vec3d b = mesh_.position(mesh_.corner_vertex(CollapseMesh::previous_corner(fan_[i])));
            distance = std::min(distance, distance_to_triangle(p, point_, a, b));
        }
        largest = std::max(largest, deviation_.carried(v) + distance);
        begin = end;
    }
    return largest;
}

void StarContraction::contract(std::span<const uint32_t> vertices) {
    bounds_.merge(vertices, kept_, point_);
    if (changes_line()) lines_.merge(vertices, kept_, point_);
    rules_.set_facing(kept_, mean_facing(vertices));
    deviation_.merge(kept_, next_deviation_);
    groups_.for_each_blend([this](std::span<const WedgeShare> shares, uint32_t into) {
        values_.blend(shares, into);
        uvs_.blend(shares, into);
    });
    for (const uint32_t triangle : gone_) mesh_.remove_triangle(triangle);
    for (const uint32_t c : fan_) mesh_.set_corner(c, kept_, groups_.becomes(mesh_.corner_wedge(c)));
    if (!moves_nothing_) mesh_.move(kept_, point_);
}

Simplified StarContraction::finish(StopReason reason, const Watch& watch) const {
    return simplified(mesh_.extract(source_, values_, watch), reason);
}

}  // namespace coppice
