#include "core/compare/elements.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <vector>

#include "core/base/watched_loop.h"
#include "core/base/watched_sort.h"
#include "core/compare/attributes.h"
#include "core/mesh/adjacency.h"

namespace coppice {

namespace {

using Corners = std::array<uint32_t, 3>;

// The same for the three rotations of a triangle.
Corners least_first(const Mesh& mesh, size_t triangle) {
    Corners v = {mesh.corner_vertex(triangle, 0), mesh.corner_vertex(triangle, 1),
                 mesh.corner_vertex(triangle, 2)};
    std::rotate(v.begin(), std::min_element(v.begin(), v.end()), v.end());
    return v;
}

uint64_t count_duplicates(const Mesh& mesh, const Watch& watch) {
    std::vector<Corners> all(mesh.triangle_count());
    watched_loop(all.size(), watch, [&](size_t t) { all[t] = least_first(mesh, t); });
    watched_sort(all.begin(), all.end(), watch, std::less<>());
    uint64_t duplicates = 0;
    watched_loop(all.size(), watch, [&](size_t t) { duplicates += t > 0 && all[t] == all[t - 1] ? 1 : 0; });
    return duplicates;
}

uint32_t find_root(std::vector<uint32_t>& parent, uint32_t v) {
    while (parent[v] != v) v = parent[v] = parent[parent[v]];
    return v;
}

// Vertices in use, and what hangs together.
void count_components(const Mesh& mesh, const Watch& watch, Elements& out) {
    std::vector<uint32_t> parent(mesh.vertex_count());
    std::iota(parent.begin(), parent.end(), 0U);
    std::vector<bool> used(mesh.vertex_count(), false);
    watched_loop(mesh.triangle_count(), watch, [&](size_t t) {
        const uint32_t first = find_root(parent, mesh.corner_vertex(t, 0));
        for (size_t c = 0; c < 3; ++c) {
            const uint32_t vertex = mesh.corner_vertex(t, c);
            used[vertex] = true;
            const uint32_t other = find_root(parent, vertex), kept = find_root(parent, first);
            parent[std::max(kept, other)] = std::min(kept, other);
        }
    });
    watched_loop(parent.size(), watch, [&](size_t v) {
        out.vertices += used[v] ? 1 : 0;
        out.components += used[v] && parent[v] == v ? 1 : 0;
    });
}

void count_edges(const Mesh& mesh, const Watch& watch, Elements& out) {
    const std::vector<Edge> all = edges(mesh, watch);
    watched_loop(all.size(), watch, [&](size_t i) {
        const Edge& edge = all[i];
        out.non_manifold_edges += edge.is_manifold() ? 0 : 1;
        out.inconsistent_edges += edge.uses() == 2 && edge.forward != edge.backward ? 1 : 0;
        if (!edge.is_border()) return;
        ++out.border_edges;
        out.border_length += length(to_double(mesh.positions[edge.b]) - to_double(mesh.positions[edge.a]));
    });
    out.euler_number = static_cast<int64_t>(out.vertices) - static_cast<int64_t>(all.size()) +
                       static_cast<int64_t>(out.triangles);
}

double smallest_angle(Vec3d a, Vec3d b, Vec3d c) {
    return std::min(
        {*angle_between(b - a, c - a), *angle_between(c - b, a - b), *angle_between(a - c, b - c)});
}

void measure_triangles(const Mesh& mesh, const Watch& watch, Elements& out) {
    const Vec3d origin = mesh.corner_position(0, 0);  // near, where rounding matters least
    watched_loop(mesh.triangle_count(), watch, [&](size_t t) {
        const Vec3d a = mesh.corner_position(t, 0), b = mesh.corner_position(t, 1),
                    c = mesh.corner_position(t, 2);
        const Vec3d normal = cross(b - a, c - a);
        if (!(squared_length(normal) > 0)) {
            ++out.degenerate_triangles;
            return;
        }
        out.area += length(normal) / 2;
        out.volume += dot(a - origin, normal) / 6;
        out.smallest_angle = std::min(out.smallest_angle, smallest_angle(a, b, c));
    });
}

}  // namespace

void Elements::add(const Elements& other) {
    triangles += other.triangles;
    vertices += other.vertices;
    degenerate_triangles += other.degenerate_triangles;
    duplicate_triangles += other.duplicate_triangles;
    non_manifold_edges += other.non_manifold_edges;
    inconsistent_edges += other.inconsistent_edges;
    border_edges += other.border_edges;
    border_length += other.border_length;
    components += other.components;
    euler_number += other.euler_number;
    area += other.area;
    volume += other.volume;
    smallest_angle = std::min(smallest_angle, other.smallest_angle);
}

Elements count_elements(const Mesh& mesh, const Watch& watch) {
    Elements out;
    out.triangles = mesh.triangle_count();
    if (mesh.triangle_count() == 0) return out;
    out.duplicate_triangles = count_duplicates(mesh, watch);
    count_components(mesh, watch, out);
    count_edges(mesh, watch, out);
    measure_triangles(mesh, watch, out);
    return out;
}

}  // namespace coppice
