#include "core/simplify/vertex_clusters.h"

#include <algorithm>
#include <array>
#include <numeric>

#include "core/base/watched_loop.h"
#include "core/mesh/weld.h"
#include "core/simplify/wedge_charts.h"
#include "core/simplify/wedge_values.h"

namespace coppice {

namespace {

uint32_t root_in(std::vector<uint32_t>& parents, uint32_t i) {
    while (parents[i] != i) i = parents[i] = parents[parents[i]];
    return i;
}

void unite(std::vector<uint32_t>& parents, uint32_t a, uint32_t b) {
    a = root_in(parents, a), b = root_in(parents, b);
    parents[std::max(a, b)] = std::min(a, b);
}

// Gives the wedges of each group the mean of all of them; parents: union-find of wedges.
void blend_groups(std::vector<uint32_t>& parents, WedgeValues& values, const Watch& watch) {
    std::vector<uint32_t> order(parents.size());
    std::iota(order.begin(), order.end(), 0U);
    for (uint32_t w = 0; w < parents.size(); ++w) parents[w] = root_in(parents, w);
    std::stable_sort(order.begin(), order.end(),
                     [&](uint32_t a, uint32_t b) { return parents[a] < parents[b]; });
    std::vector<WedgeShare> shares;
    for (size_t first = 0, last = 0; first < order.size(); first = last) {
        if (first % 1024 == 0) watch.check();
        while (last < order.size() && parents[order[last]] == parents[order[first]]) ++last;
        if (last - first < 2) continue;
        shares.clear();
        for (size_t i = first; i < last; ++i)
            shares.push_back({order[i], 1.0 / static_cast<double>(last - first)});
        values.blend(shares, order[first]);
    }
}

// Of the triangles, those that are the first on their three vertices.
std::vector<uint32_t> first_on_vertices(const std::vector<std::array<uint32_t, 3>>& corners) {
    std::vector<std::array<uint32_t, 4>> keys;
    for (uint32_t t = 0; t < corners.size(); ++t) {
        std::array<uint32_t, 3> v = corners[t];
        std::sort(v.begin(), v.end());
        keys.push_back({v[0], v[1], v[2], t});
    }
    std::sort(keys.begin(), keys.end());
    std::vector<uint32_t> kept;
    for (size_t i = 0; i < keys.size(); ++i) {
        if (i == 0 || !std::equal(keys[i].begin(), keys[i].begin() + 3, keys[i - 1].begin()))
            kept.push_back(keys[i][3]);
    }
    std::sort(kept.begin(), kept.end());
    return kept;
}

}  // namespace

VertexClusters::VertexClusters(const Mesh& mesh)
    : parents_(mesh.vertex_count()), merged_(mesh.vertex_count()) {
    std::iota(parents_.begin(), parents_.end(), 0U);
    for (const Vec3f p : mesh.positions) positions_.push_back(to_double(p));
}

uint32_t VertexClusters::root(uint32_t vertex) {
    return root_in(parents_, vertex);
}

void VertexClusters::merge(std::span<const uint32_t> roots, Vec3d point) {
    const uint32_t kept = *std::min_element(roots.begin(), roots.end());
    for (const uint32_t r : roots) parents_[r] = kept;
    positions_[kept] = point;
    merged_[kept] = true;
}

VertexClusters::Count VertexClusters::count(const Mesh& mesh) {
    Count result;
    std::vector<bool> used(parents_.size());
    for (size_t t = 0; t < mesh.triangle_count(); ++t) {
        const uint32_t v[] = {root(mesh.corner_vertex(t, 0)), root(mesh.corner_vertex(t, 1)),
                              root(mesh.corner_vertex(t, 2))};
        if (v[0] == v[1] || v[1] == v[2] || v[2] == v[0]) continue;
        ++result.triangles;
        for (const uint32_t r : v) {
            result.vertices += used[r] ? 0 : 1;
            used[r] = true;
        }
    }
    return result;
}

Mesh VertexClusters::extract(const Mesh& source, const Watch& watch) {
    WedgeCharts charts = wedge_charts(source, watch);
    WedgeValues values(source, charts.source);
    std::vector<uint32_t> groups(charts.source.size());  // of wedges; union-find
    std::iota(groups.begin(), groups.end(), 0U);
    std::vector<std::array<uint32_t, 3>> corners, wedges;
    std::vector<uint32_t> slots;
    watched_loop(source.triangle_count(), watch, [&](size_t t) {
        std::array<uint32_t, 3> v{}, w{};
        for (size_t k = 0; k < 3; ++k) {
            v[k] = root(source.corner_vertex(t, k));
            w[k] = charts.corner_wedge[3 * t + k];
        }
        for (size_t k = 0; k < 3; ++k)
            if (v[k] == v[(k + 1) % 3]) unite(groups, w[k], w[(k + 1) % 3]);
        if (v[0] == v[1] || v[1] == v[2] || v[2] == v[0]) return;
        corners.push_back(v);
        wedges.push_back(w);
        slots.push_back(source.triangle_slot[t]);
    });
    blend_groups(groups, values, watch);

    Mesh mesh = source;
    mesh.position_storage = {};
    for (uint32_t v = 0; v < parents_.size(); ++v)
        if (parents_[v] != v || positions_[v] != to_double(source.positions[v]))
            mesh.positions[v] = to_float(positions_[root(v)]);
    mesh.triangles.clear();
    mesh.triangle_slot.clear();
    mesh.wedge_vertex.assign(groups.size(), 0);
    std::vector<uint32_t> own(groups.size());
    for (uint32_t w = 0; w < groups.size(); ++w) own[w] = groups[w];
    for (const uint32_t t : first_on_vertices(corners)) {
        for (size_t k = 0; k < 3; ++k) {
            const uint32_t wedge = groups[wedges[t][k]];
            mesh.triangles.push_back(wedge);
            mesh.wedge_vertex[wedge] = corners[t][k];
        }
        mesh.triangle_slot.push_back(slots[t]);
    }
    values.write(own, mesh);
    drop_unused(mesh, watch);
    return mesh;
}

double VertexClusters::largest_move(const Mesh& mesh) {
    double largest = 0;
    for (uint32_t v = 0; v < parents_.size(); ++v)
        largest = std::max(largest, squared_length(positions_[root(v)] - to_double(mesh.positions[v])));
    return std::sqrt(largest);
}

}  // namespace coppice
