#include "core/simplify/collapse_mesh.h"

#include <cassert>

#include "core/base/watched_loop.h"
#include "core/mesh/weld.h"
#include "core/simplify/wedge_charts.h"

namespace coppice {

CollapseMesh::CollapseMesh(const Mesh& source, const Watch& watch)
    : corner_vertex_(watched_vector(source.triangles.size(), watch, no_index)),
      after_(watched_vector(source.triangles.size(), watch, no_index)),
      before_(watched_vector(source.triangles.size(), watch, no_index)),
      first_corner_(watched_vector(source.vertex_count(), watch, no_index)),
      valence_(watched_vector<uint32_t>(source.vertex_count(), watch)) {
    WedgeCharts charts = wedge_charts(source, watch);
    corner_wedge_ = std::move(charts.corner_wedge);
    wedge_begin_ = std::move(charts.begin);
    wedge_slot_ = std::move(charts.slot);
    wedge_source_ = std::move(charts.source);
    wedge_chart_ = std::move(charts.chart);

    // Backwards, so that every list ascends.
    watched_loop(source.triangle_count(), watch, [&](size_t i) {
        const size_t t = source.triangle_count() - 1 - i;
        const uint32_t a = source.corner_vertex(t, 0), b = source.corner_vertex(t, 1),
                       c = source.corner_vertex(t, 2);
        if (a == b || b == c || c == a) return;
        const auto corner = static_cast<uint32_t>(3 * t);
        corner_vertex_[corner] = a, corner_vertex_[corner + 1] = b, corner_vertex_[corner + 2] = c;
        for (uint32_t k = 3; k-- > 0;) link(corner + k);
        ++live_triangles_;
    });

    positions_.reserve(source.vertex_count());
    watched_loop(source.vertex_count(), watch, [&](size_t v) {
        positions_.push_back(to_double(source.positions[v]));
        if (is_live_vertex(static_cast<uint32_t>(v))) box_.extend(positions_[v]);
    });
    if (box_.empty()) return;
    centre_ = (box_.min + box_.max) * 0.5;
    watched_loop(positions_.size(), watch, [&](size_t v) { positions_[v] = positions_[v] - centre_; });
    box_.min = box_.min - centre_;
    box_.max = box_.max - centre_;
}

void CollapseMesh::link(uint32_t corner) {
    const uint32_t vertex = corner_vertex_[corner];
    const uint32_t head = first_corner_[vertex];
    before_[corner] = no_index;
    after_[corner] = head;
    if (head != no_index) before_[head] = corner;
    first_corner_[vertex] = corner;
    if (++valence_[vertex] == 1) ++live_vertices_;
}

void CollapseMesh::unlink(uint32_t corner) {
    const uint32_t vertex = corner_vertex_[corner];
    const uint32_t before = before_[corner], after = after_[corner];
    if (before == no_index) {
        first_corner_[vertex] = after;
    } else {
        after_[before] = after;
    }
    if (after != no_index) before_[after] = before;
    if (--valence_[vertex] == 0) --live_vertices_;
}

void CollapseMesh::remove_triangle(uint32_t triangle) {
    for (uint32_t corner = 3 * triangle; corner < 3 * triangle + 3; ++corner) {
        unlink(corner);
        corner_vertex_[corner] = no_index;
    }
    --live_triangles_;
}

void CollapseMesh::collapse(uint32_t removed, uint32_t kept, const std::vector<uint32_t>& wedge_map) {
    const uint32_t first_wedge = wedge_begin_[removed];
    for (uint32_t corner = first_corner_[removed], after = no_index; corner != no_index; corner = after) {
        after = after_[corner];
        if (corner_vertex_[next_corner(corner)] == kept || corner_vertex_[previous_corner(corner)] == kept) {
            remove_triangle(corner / 3);
            continue;
        }
        const uint32_t wedge = wedge_map[corner_wedge_[corner] - first_wedge];
        assert(wedge != no_index);
        set_corner(corner, kept, wedge);
    }
}

void CollapseMesh::set_corner(uint32_t corner, uint32_t vertex, uint32_t wedge) {
    unlink(corner);
    corner_wedge_[corner] = wedge;
    corner_vertex_[corner] = vertex;
    link(corner);
}

void CollapseMesh::move(uint32_t vertex, Vec3d position) {
    if (moved_.empty()) moved_.resize(positions_.size());
    moved_[vertex] = true;
    positions_[vertex] = position;
}

Mesh CollapseMesh::extract(const Mesh& source, const Watch& watch) const {
    Mesh mesh = without_triangles(source, watch);
    mesh.triangles.reserve(3 * size_t{live_triangles_});
    mesh.triangle_slot.reserve(live_triangles_);
    watched_loop(triangle_count(), watch, [&](size_t t) {
        if (!is_live_triangle(static_cast<uint32_t>(t))) return;
        for (size_t corner = 3 * t; corner < 3 * t + 3; ++corner) {
            mesh.triangles.push_back(wedge_source_[corner_wedge_[corner]]);
        }
        mesh.triangle_slot.push_back(source.triangle_slot[t]);
    });
    drop_unused(mesh, watch);
    return mesh;
}

Mesh CollapseMesh::extract(const Mesh& source, const WedgeValues& values, const Watch& watch) const {
    Mesh mesh = without_geometry(source);
    if (!moved_.empty()) mesh.position_storage = {};
    std::vector<uint32_t> wedge_number(wedge_count(), no_index), vertex_number(vertex_count(), no_index);
    std::vector<uint32_t> wedges;
    mesh.triangles.reserve(3 * size_t{live_triangles_});
    mesh.triangle_slot.reserve(live_triangles_);
    mesh.positions.reserve(live_vertices_);
    const auto vertex = [&](uint32_t v) {
        if (vertex_number[v] != no_index) return vertex_number[v];
        const bool moved = !moved_.empty() && moved_[v];
        mesh.positions.push_back(moved ? to_float(positions_[v] + centre_) : source.positions[v]);
        return vertex_number[v] = static_cast<uint32_t>(mesh.positions.size() - 1);
    };
    watched_loop(triangle_count(), watch, [&](size_t t) {
        if (!is_live_triangle(static_cast<uint32_t>(t))) return;
        for (size_t corner = 3 * t; corner < 3 * t + 3; ++corner) {
            uint32_t& number = wedge_number[corner_wedge_[corner]];
            if (number == no_index) {
                number = static_cast<uint32_t>(wedges.size());
                wedges.push_back(corner_wedge_[corner]);
                mesh.wedge_vertex.push_back(vertex(corner_vertex_[corner]));
            }
            mesh.triangles.push_back(number);
        }
        mesh.triangle_slot.push_back(source.triangle_slot[t]);
    });
    values.write(wedges, mesh);
    return mesh;
}

}  // namespace coppice
