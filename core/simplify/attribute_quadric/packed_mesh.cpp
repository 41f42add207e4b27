#include "core/simplify/attribute_quadric/packed_mesh.h"

#include <algorithm>
#include <numeric>
#include <utility>

#include "core/base/watched_loop.h"
#include "core/mesh/bounds.h"
#include "core/simplify/wedge_charts.h"

namespace coppice {

namespace {

bool wedges_are_vertices(const Mesh& mesh) {
    if (mesh.slots.size() > 1 || mesh.wedge_count() != mesh.vertex_count()) return false;
    for (uint32_t w = 0; w < mesh.wedge_count(); ++w)
        if (mesh.wedge_vertex[w] != w) return false;
    return true;
}

// What a vertex knows of the edge to one neighbour.
struct Edge {
    uint32_t neighbour = 0;
    uint32_t along = 0, against = 0;            // triangles on either side
    std::array<uint32_t, 2> wedges_along = {};  // at the vertex, at the neighbour
    std::array<uint32_t, 2> wedges_against = {};

    bool is_crowded() const { return along > 1 || against > 1; }
    bool is_border() const { return along + against == 1; }
    bool is_seam() const { return !is_border() && wedges_along != wedges_against; }
};

}  // namespace

PackedMesh::PackedMesh(const Mesh& source, const Watch& watch) {
    take_triangles(source, watch);
    watched_resize(positions, source.vertex_count(), watch);
    link(watch);
    Bounds box;
    for (uint32_t v = 0; v < vertex_count(); ++v)
        if (valence(v) > 0) box.extend(to_double(source.positions[v]));
    if (!box.empty()) {
        centre = (box.min + box.max) * 0.5;
        diagonal = box.diagonal();
    }
    const double scale = diagonal > 0 ? 1 / diagonal : 0;
    if (!box.empty()) half_box = to_float((box.max - centre) * scale);
    watched_loop(vertex_count(), watch, [&](size_t v) {
        positions[v] = to_float((to_double(source.positions[v]) - centre) * scale);
    });
    vertex_source.resize(source.vertex_count());
    std::iota(vertex_source.begin(), vertex_source.end(), 0U);
    kinds.resize(vertex_count());
    watched_loop(vertex_count(), watch, [&](size_t v) { kinds[v] = kind_of(static_cast<uint32_t>(v)); });
    lock_extremes();
    drop_unused_vertices(watch);
}

void PackedMesh::drop_unused_vertices(const Watch& watch) {
    bool all_used = true;
    for (uint32_t v = 0; v < vertex_count(); ++v) all_used = all_used && valence(v) > 0;
    if (all_used) return;
    std::vector<uint32_t> same(std::max(vertex_count(), wedge_count()));
    std::iota(same.begin(), same.end(), 0U);
    compact(same, same, watch);
}

void PackedMesh::take_triangles(const Mesh& source, const Watch& watch) {
    const bool plain = wedges_are_vertices(source);
    WedgeCharts charts;
    if (!plain) charts = wedge_charts(source, watch);
    triangles.reserve(source.triangles.size());
    triangle_slot.reserve(source.triangle_count());
    if (!plain) corner_wedges.reserve(source.triangles.size());
    watched_loop(source.triangle_count(), watch, [&](size_t t) {
        const uint32_t a = source.corner_vertex(t, 0), b = source.corner_vertex(t, 1),
                       c = source.corner_vertex(t, 2);
        if (a == b || b == c || c == a) return;
        triangles.insert(triangles.end(), {a, b, c});
        triangle_slot.push_back(source.triangle_slot[t]);
        if (plain) return;
        const auto first = charts.corner_wedge.begin() + static_cast<std::ptrdiff_t>(3 * t);
        corner_wedges.insert(corner_wedges.end(), first, first + 3);
    });
    if (plain) {
        wedge_source.resize(source.wedge_count());
        std::iota(wedge_source.begin(), wedge_source.end(), 0U);
    } else {
        wedge_source = std::move(charts.source);
    }
}

// Counting sort of corners by vertex.
void PackedMesh::link(const Watch& watch) {
    first_spoke.assign(size_t{vertex_count()} + 1, 0);
    spokes.resize(triangles.size());
    if (has_wedges()) spoke_corner.resize(triangles.size());
    watched_loop(triangles.size(), watch, [&](size_t corner) { ++first_spoke[triangles[corner]]; });
    uint32_t sum = 0;
    for (uint32_t& first : first_spoke) sum += std::exchange(first, sum);
    watched_loop(triangle_count(), watch, [&](size_t t) {
        const auto corner = static_cast<uint32_t>(3 * t);
        const uint32_t a = triangles[corner], b = triangles[corner + 1], c = triangles[corner + 2];
        const uint32_t at_a = first_spoke[a]++, at_b = first_spoke[b]++, at_c = first_spoke[c]++;
        spokes[at_a] = {b, c}, spokes[at_b] = {c, a}, spokes[at_c] = {a, b};
        if (has_wedges())
            spoke_corner[at_a] = corner, spoke_corner[at_b] = corner + 1, spoke_corner[at_c] = corner + 2;
    });
    std::rotate(first_spoke.begin(), first_spoke.end() - 1, first_spoke.end());
    first_spoke.front() = 0;
}

std::optional<uint32_t> PackedMesh::along(uint32_t vertex, uint32_t other) const {
    for (uint32_t s = first_spoke[vertex]; s < first_spoke[vertex + 1]; ++s)
        if (spokes[s].next == other) return s;
    return {};
}

std::optional<uint32_t> PackedMesh::against(uint32_t vertex, uint32_t other) const {
    for (uint32_t s = first_spoke[vertex]; s < first_spoke[vertex + 1]; ++s)
        if (spokes[s].previous == other) return s;
    return {};
}

// Whether every edge has as many triangles along as against it, with the same wedges on both sides: told by
// sums, which differ but for a chance of 2^-64. Edges of four triangles pass; nothing collapses them.
bool PackedMesh::is_plain(uint32_t vertex) const {
    uint64_t difference = 0;
    const auto scrambled = [](uint64_t n) {
        n = (n + 1) * 0x9e3779b97f4a7c15ULL;
        return n ^ (n >> 32);
    };
    const uint32_t begin = first_spoke[vertex], end = first_spoke[vertex + 1];
    const uint32_t wedge = wedges(vertex, begin)[0];
    for (uint32_t s = begin; s < end; ++s) {
        const auto [own, next, previous] = wedges(vertex, s);
        if (own != wedge) return false;
        difference += scrambled(next) - scrambled(previous);
    }
    return difference == 0;
}

// From one triangle to the next, all are reached. No edge has more than two.
bool PackedMesh::is_one_fan(uint32_t vertex) const {
    const uint32_t begin = first_spoke[vertex], end = first_spoke[vertex + 1];
    uint32_t first = begin;
    for (uint32_t s = begin; s < end; ++s)
        if (!against(vertex, spokes[s].next)) first = s;  // of half a disc
    uint32_t steps = 0, at = first;
    do {
        ++steps;
        const std::optional<uint32_t> after = along(vertex, spokes[at].previous);
        if (!after) break;
        at = *after;
    } while (at != first);
    return steps == valence(vertex);
}

VertexKind PackedMesh::kind_of(uint32_t vertex) const {
    if (valence(vertex) == 0 || is_hub(vertex)) return VertexKind::complex;
    if (is_plain(vertex)) return VertexKind::manifold;
    std::array<Edge, 2 * largest_valence> edges;
    uint32_t count = 0;
    const auto edge_to = [&](uint32_t neighbour) -> Edge& {
        for (uint32_t i = 0; i < count; ++i)
            if (edges[i].neighbour == neighbour) return edges[i];
        edges[count].neighbour = neighbour;
        return edges[count++];
    };
    for (uint32_t s = first_spoke[vertex]; s < first_spoke[vertex + 1]; ++s) {
        const auto [own, next, previous] = wedges(vertex, s);
        Edge& ahead = edge_to(spokes[s].next);
        ++ahead.along, ahead.wedges_along = {own, next};
        Edge& behind = edge_to(spokes[s].previous);
        ++behind.against, behind.wedges_against = {own, previous};
    }
    uint32_t borders = 0, seams = 0;
    bool parts = true;  // every seam gives the vertex another wedge on its other side
    for (uint32_t i = 0; i < count; ++i) {
        if (edges[i].is_crowded()) return VertexKind::complex;
        borders += edges[i].is_border();
        seams += edges[i].is_seam();
        parts = parts && (!edges[i].is_seam() || edges[i].wedges_along[0] != edges[i].wedges_against[0]);
    }
    if (!is_one_fan(vertex)) return VertexKind::complex;
    if (borders == 0 && seams == 0) return VertexKind::manifold;
    if (borders == 2 && seams == 0) return VertexKind::border;
    if (borders == 0 && seams == 2 && parts) return VertexKind::seam;
    return VertexKind::corner;
}

// One vertex holds each side of the box.
void PackedMesh::lock_extremes() {
    const auto lock = [this](auto coordinate) {
        uint32_t least = no_index, most = no_index;
        for (uint32_t v = 0; v < vertex_count(); ++v) {
            if (valence(v) == 0) continue;
            if (least == no_index || coordinate(v) < coordinate(least)) least = v;
            if (most == no_index || coordinate(v) > coordinate(most)) most = v;
        }
        for (const uint32_t v : {least, most})
            if (v != no_index && kinds[v] != VertexKind::complex) kinds[v] = VertexKind::corner;
    };
    lock([this](uint32_t v) { return positions[v].x; });
    lock([this](uint32_t v) { return positions[v].y; });
    lock([this](uint32_t v) { return positions[v].z; });
}

Renumbering PackedMesh::compact(std::span<const uint32_t> vertex_becomes,
                                std::span<const uint32_t> wedge_becomes, const Watch& watch) {
    Renumbering result;
    result.vertices.assign(vertex_count(), no_index);
    if (has_wedges()) result.wedges.assign(wedge_count(), no_index);
    result.triangles.assign(triangle_count(), no_index);
    uint32_t& left = result.triangles_left;
    watched_loop(triangle_count(), watch, [&](size_t t) {
        std::array<uint32_t, 3> v{};
        for (size_t k = 0; k < 3; ++k) v[k] = vertex_becomes[triangles[3 * t + k]];
        if (v[0] == v[1] || v[1] == v[2] || v[2] == v[0]) return;
        for (size_t k = 0; k < 3; ++k) {
            triangles[size_t{3} * left + k] = v[k];
            result.vertices[v[k]] = 0;
            if (!has_wedges()) continue;
            const uint32_t wedge = wedge_becomes[corner_wedges[3 * t + k]];
            corner_wedges[size_t{3} * left + k] = wedge;
            result.wedges[wedge] = 0;
        }
        triangle_slot[left] = triangle_slot[t];
        result.triangles[t] = left++;
    });
    triangles.resize(size_t{3} * left);
    triangle_slot.resize(left);
    const auto number = [](std::vector<uint32_t>& numbers) {
        uint32_t next = 0;
        for (uint32_t& n : numbers)
            if (n != no_index) n = next++;
        return next;
    };
    result.vertices_left = number(result.vertices);
    for (uint32_t& v : triangles) v = result.vertices[v];
    renumber(positions, result.vertices, result.vertices_left, watch);
    renumber(kinds, result.vertices, result.vertices_left, watch);
    renumber(vertex_source, result.vertices, result.vertices_left, watch);
    if (has_wedges()) {
        corner_wedges.resize(size_t{3} * left);
        result.wedges_left = number(result.wedges);
        for (uint32_t& w : corner_wedges) w = result.wedges[w];
    } else {
        result.wedges = result.vertices;
        result.wedges_left = result.vertices_left;
    }
    renumber(wedge_source, result.wedges, result.wedges_left, watch);
    link(watch);
    return result;
}

}  // namespace coppice
