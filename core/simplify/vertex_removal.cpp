#include "core/simplify/vertex_removal.h"

#include <algorithm>
#include <limits>

#include "core/simplify/delaunay_flips.h"
#include "core/simplify/neighbours.h"

namespace coppice {

VertexRemoval::VertexRemoval(const Mesh& source, const Target& target, Stitch stitch, bool lines,
                             const Watch& watch)
    : GuardedMesh(source, target, {}, watch),
      stitch_(stitch),
      lines_may_go_(lines),
      normals_(rules_.first_normals()) {}

bool VertexRemoval::kind_allows(uint32_t vertex) const {
    if (mesh_.valence(vertex) > largest_removable_valence) return false;
    switch (kind(vertex)) {
        case VertexKind::manifold:
            return true;
        case VertexKind::border:
            return lines_may_go_;
        case VertexKind::seam:
            return lines_may_go_ && stitch_ != Stitch::paper;
        default:
            return false;
    }
}

uint32_t VertexRemoval::triangles_saved(uint32_t vertex) const {
    return (kind(vertex) == VertexKind::border ? 1 : 2) - (stitch_ == Stitch::paper ? 1 : 0);
}

Refusal VertexRemoval::try_remove(uint32_t vertex) {
    const Refusal refusal = check(vertex);
    if (refusal == Refusal::none) {
        remove(vertex);
    } else {
        refusals_.add(refusal);
    }
    return refusal;
}

Refusal VertexRemoval::check(uint32_t vertex) {
    if (!kind_allows(vertex)) return Refusal::locked;
    if (!fan_.gather(mesh_, vertex)) return Refusal::topology;
    if (fan_.is_closed() == (kind(vertex) == VertexKind::border)) return Refusal::topology;
    if (stitch_ != Stitch::paper && !bounds_.may_remove(vertex)) return Refusal::bounds;
    ring_size_ = static_cast<uint32_t>(fan_.ring().size());
    if (!find_parts(vertex)) return Refusal::topology;
    if (stitch_ != Stitch::paper && along_ != no_index && !lines_.may_remove(vertex, along_))
        return Refusal::topology;
    new_triangles_.clear();
    for (const Part& part : parts_)
        if (!fill(part, vertex)) return Refusal::topology;
    next_deviation_ = deviation(vertex);
    return check_deviation(next_deviation_);
}

bool VertexRemoval::is_seam(uint32_t spoke) const {
    const uint32_t before = fan_.corner((spoke + ring_size_ - 1) % ring_size_), after = fan_.corner(spoke);
    const auto chart = [this](uint32_t corner) { return mesh_.wedge_chart(mesh_.corner_wedge(corner)); };
    return chart(before) != chart(after) ||
           chart(CollapseMesh::previous_corner(before)) != chart(CollapseMesh::next_corner(after));
}

// The whole, but for where a seam or a crease passes through.
bool VertexRemoval::find_parts(uint32_t vertex) {
    const uint32_t count = fan_.triangle_count();
    parts_.assign(1, {0, count, fan_.is_closed()});
    along_ = no_index;
    if (!fan_.is_closed()) {
        along_ = fan_.ring().front();
        if (stitch_ == Stitch::paper) return count > 1;
        // The border runs straight on: along a new edge, or along the one that an ear leaves.
        const uint32_t from = fan_.ring().front(), to = fan_.ring().back();
        const bool is_chart = kind(from) == VertexKind::corner && kind(to) == VertexKind::corner;
        return count > 1 ? edge_uses(mesh_, from, to) == 0 : edge_uses(mesh_, from, to) == 2 && !is_chart;
    }
    if (stitch_ == Stitch::paper) return true;
    const bool on_seam = kind(vertex) == VertexKind::seam;
    std::array<uint32_t, 2> spokes{};
    uint32_t found = 0;
    for (uint32_t i = 0, before = count - 1; i < count; before = i++) {
        const Vec3f one = normals_[fan_.corner(before) / 3], other = normals_[fan_.corner(i) / 3];
        const bool breaks = on_seam ? is_seam(i) : dot(one, other) < crease_cosine;
        if (!breaks) continue;
        if (found < 2) spokes[found] = i;
        ++found;
    }
    if (found == 2 && split_at(spokes[0], spokes[1])) {
        if (on_seam) along_ = fan_.ring()[spokes[0]];
        return true;
    }
    return !on_seam;
}

bool VertexRemoval::split_at(uint32_t one, uint32_t other) {
    const uint32_t count = fan_.triangle_count();
    if (other - one < 2 || count - (other - one) < 2) return false;
    if (edge_uses(mesh_, fan_.ring()[one], fan_.ring()[other]) > 0) return false;
    parts_ = {{one, other - one, false}, {other, count - (other - one), false}};
    return true;
}

bool VertexRemoval::fill(const Part& part, uint32_t vertex) {
    if (part.ring_size() < 3) return true;  // an ear at a border: nothing takes its place
    points_.clear();
    for (uint32_t i = 0; i < part.ring_size(); ++i)
        points_.push_back(mesh_.position(fan_.ring()[place(part, i)]));
    const auto may_join = [this, &part](uint32_t i, uint32_t j) {
        return edge_uses(mesh_, fan_.ring()[place(part, i)], fan_.ring()[place(part, j)]) == 0;
    };
    if (!hole_.fill(points_, stitch_, may_join)) return false;
    return std::all_of(hole_.triangles().begin(), hole_.triangles().end(),
                       [&](const auto& places) { return add(part, places, vertex); });
}

bool VertexRemoval::add(const Part& part, std::array<uint32_t, 3> places, uint32_t vertex) {
    NewTriangle added;
    // Turned so that an edge of the ring, if there is one, lies where the replaced triangle has it.
    for (uint32_t k = 0; k < 3 && added.replaces == no_index; ++k) {
        const uint32_t end = part.closed && places[1] + 1 == part.count ? 0 : places[1] + 1;
        if (places[2] == end) {
            added.replaces = place(part, places[1]);
        } else {
            std::rotate(places.begin(), places.begin() + 1, places.end());
        }
    }
    for (size_t k = 0; k < 3; ++k) added.vertices[k] = fan_.ring()[place(part, places[k])];
    if (stitch_ == Stitch::paper) {
        const Vec3d a = points_[places[0]];
        added.normal = to_float(normalized(cross(points_[places[1]] - a, points_[places[2]] - a)));
    } else {
        const auto normal = rules_.normal_of_filling(added.vertices, rules_.facing(vertex));
        if (!normal || (part.ring_size() == 3 && rules_.has_triangle(added.vertices))) return false;
        added.normal = *normal;
    }
    for (size_t k = 0; k < 3; ++k) added.wedges[k] = wedge_at(part, places[k], added.normal);
    new_triangles_.push_back(added);
    return stitch_ == Stitch::paper || !uvs_.any() || uvs_.is_wound_well(added.wedges);
}

// Where the two triangles there differ, that of the one which faces more like the new triangle.
uint32_t VertexRemoval::wedge_at(const Part& part, uint32_t i, Vec3f normal) const {
    const bool begins_path = !part.closed && i == 0, ends_path = !part.closed && i == part.count;
    const uint32_t after = fan_.corner(place(part, ends_path ? i - 1 : i));
    const uint32_t before = fan_.corner(place(part, begins_path ? i : i > 0 ? i - 1 : part.count - 1));
    const uint32_t begins = mesh_.corner_wedge(CollapseMesh::next_corner(after));
    const uint32_t ends = mesh_.corner_wedge(CollapseMesh::previous_corner(before));
    if (begins_path || begins == ends) return begins;
    if (ends_path) return ends;
    const auto facing = [&](uint32_t corner) { return dot(normals_[corner / 3], normal); };
    return facing(after) >= facing(before) ? begins : ends;
}

// To the new triangle that it is above, or else, as Deviation::after, to the nearest.
double VertexRemoval::deviation(uint32_t vertex) const {
    const Vec3d p = mesh_.position(vertex);
    double distance = std::numeric_limits<double>::infinity();
    for (const NewTriangle& t : new_triangles_) {
        const auto above = distance_from_above(p, mesh_.position(t.vertices[0]),
                                               mesh_.position(t.vertices[1]), mesh_.position(t.vertices[2]));
        if (above) return deviation_.carried(vertex) + *above;
    }
    const auto to = [&](uint32_t a, uint32_t b, uint32_t c) {
        return distance_to_triangle(p, mesh_.position(a), mesh_.position(b), mesh_.position(c));
    };
    for (const NewTriangle& t : new_triangles_)
        distance = std::min(distance, to(t.vertices[0], t.vertices[1], t.vertices[2]));
    const uint32_t first = fan_.ring().front(), last = fan_.ring().back();
    if (new_triangles_.empty()) distance = to(first, last, last);
    return deviation_.carried(vertex) + distance;
}

void VertexRemoval::remove(uint32_t vertex) {
    ++removed_;
    bounds_.remove(vertex);
    if (along_ != no_index) lines_.remove(vertex, along_);
    const Vec3d p = mesh_.position(vertex);
    const uint32_t nearest =
        *std::min_element(fan_.ring().begin(), fan_.ring().end(), [&](uint32_t a, uint32_t b) {
            return squared_length(mesh_.position(a) - p) < squared_length(mesh_.position(b) - p);
        });
    deviation_.merge(nearest, std::max(deviation_.carried(nearest), next_deviation_));

    replace_fan();
}

// New triangles take the places of old ones, where they can of those that they share an edge with.
void VertexRemoval::replace_fan() {
    taken_.assign(fan_.triangle_count(), false);
    for (NewTriangle& t : new_triangles_) {
        if (t.replaces != no_index && taken_[t.replaces]) t.replaces = no_index;
        if (t.replaces != no_index) taken_[t.replaces] = true;
    }
    for (const NewTriangle& t : new_triangles_) {
        uint32_t old = t.replaces;
        if (old == no_index) {
            old = static_cast<uint32_t>(std::find(taken_.begin(), taken_.end(), false) - taken_.begin());
            taken_[old] = true;
        }
        uint32_t corner = fan_.corner(old);
        normals_[corner / 3] = t.normal;
        for (size_t k = 0; k < 3; ++k, corner = CollapseMesh::next_corner(corner)) {
            if (mesh_.corner_vertex(corner) != t.vertices[k] || mesh_.corner_wedge(corner) != t.wedges[k])
                mesh_.set_corner(corner, t.vertices[k], t.wedges[k]);
        }
    }
    for (uint32_t i = 0; i < fan_.triangle_count(); ++i)
        if (!taken_[i]) mesh_.remove_triangle(fan_.corner(i) / 3);
}

Simplified VertexRemoval::finish(StopReason reason, const Watch& watch) {
    if (stitch_ == Stitch::delaunay && removed_ > 0) delaunay_flips(mesh_, uvs_, watch);
    return simplified(mesh_.extract(source_, watch), reason);
}

}  // namespace coppice
