#include "core/simplify/plane_error.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "core/base/watched_loop.h"

namespace coppice {

namespace {

constexpr double seam_weight = 1;  // for each side

// The point may lie this many edges from the edge's middle; beyond, planes are nearly parallel.
constexpr double farthest_in_edges = 1.5;
// Below this part of its trace cubed, the determinant of A is rounding.
constexpr double least_determinant = 1e-9;

// Solves Ap = -b by Cramer's rule.
std::optional<Vec3d> solve(const Quadric& q) {
    const double cxx = q.yy * q.zz - q.yz * q.yz, cxy = q.xz * q.yz - q.xy * q.zz,
                 cxz = q.xy * q.yz - q.xz * q.yy;
    const double determinant = q.xx * cxx + q.xy * cxy + q.xz * cxz;
    const double trace = q.xx + q.yy + q.zz;
    if (!(determinant > least_determinant * trace * trace * trace)) return {};
    const double cyy = q.xx * q.zz - q.xz * q.xz, cyz = q.xy * q.xz - q.xx * q.yz,
                 czz = q.xx * q.yy - q.xy * q.xy;
    return Vec3d{cxx * q.bx + cxy * q.by + cxz * q.bz, cxy * q.bx + cyy * q.by + cyz * q.bz,
                 cxz * q.bx + cyz * q.by + czz * q.bz} *
           (-1 / determinant);
}

// On the line b + t (a - b) the quadric is a parabola with its least at t = -d.(Ab + b) / d.Ad, d = a - b.
Vec3d least_between(const Quadric& q, Vec3d a, Vec3d b) {
    const Vec3d d = a - b;
    const auto times = [&](Vec3d p) {
        return Vec3d{q.xx * p.x + q.xy * p.y + q.xz * p.z, q.xy * p.x + q.yy * p.y + q.yz * p.z,
                     q.xz * p.x + q.yz * p.y + q.zz * p.z};
    };
    const double curvature = dot(d, times(d));
    const double scale = (q.xx + q.yy + q.zz) * squared_length(d);
    if (!(curvature > 1e-12 * scale)) {  // flat: nothing speaks for an end
        const Vec3d middle = (a + b) * 0.5;
        const double at_middle = q(middle), least_end = std::min(q(a), q(b));
        return at_middle <= least_end ? middle : q(a) < q(b) ? a : b;
    }
    const double t = -dot(d, times(b) + Vec3d{q.bx, q.by, q.bz}) / curvature;
    return b + d * std::clamp(t, 0.0, 1.0);
}

}  // namespace

Vec3d least_point(const Quadric& q, Vec3d a, Vec3d b, Freedom freedom) {
    if (freedom == Freedom::end_point) return b;
    if (freedom == Freedom::anywhere) {
        const std::optional<Vec3d> point = solve(q);
        const double reach = farthest_in_edges * length(a - b);
        if (point && squared_length(*point - (a + b) * 0.5) <= reach * reach) return *point;
    }
    return least_between(q, a, b);
}

PlaneQuadrics::PlaneQuadrics(const CollapseParts& parts, const PlaneOptions& options, const Watch& watch)
    : mesh_(parts.mesh),
      options_(options),
      quadrics_(parts.mesh.vertex_count()),
      weights_(parts.mesh.vertex_count(), 0.0),
      line_of_(watched_vector(parts.joins ? parts.mesh.vertex_count() : 0, watch, no_index)) {
    add_triangles(watch);
    add_lines(parts.features, watch);
}

void PlaneQuadrics::add_triangles(const Watch& watch) {
    for_each_triangle(mesh_, watch, [&](uint32_t, const std::array<uint32_t, 3>& v) {
        const Vec3d a = mesh_.position(v[0]);
        const Vec3d twice_area = area_normal(a, mesh_.position(v[1]), mesh_.position(v[2]));
        const double area = 0.5 * length(twice_area);
        if (!(area > 0)) return;
        const Vec3d normal = normalized(twice_area);
        const double weight =
            (options_.by_area ? area : 1) * (options_.instance_weight ? options_.instance_weight(normal) : 1);
        const Quadric plane = plane_quadric(normal, a, weight);
        for (const uint32_t vertex : v) {
            quadrics_[vertex] += plane;
            weights_[vertex] += weight;
        }
    });
}

void PlaneQuadrics::add_lines(std::span<const FeatureEdge> edges, const Watch& watch) {
    watched_loop(edges.size(), watch, [&](size_t i) {
        const Quadric plane = plane_of_line(edges[i]);
        line_quadric(edges[i].a) += plane;
        line_quadric(edges[i].b) += plane;
    });
}

Quadric& PlaneQuadrics::line_quadric(uint32_t vertex) {
    if (line_of_.empty()) return quadrics_[vertex];
    uint32_t& line = line_of_[vertex];
    if (line == no_index) {
        line = static_cast<uint32_t>(lines_.size());
        lines_.emplace_back();
    }
    return lines_[line];
}

// Through a border or seam edge, perpendicular to the triangle.
Quadric PlaneQuadrics::plane_of_line(const FeatureEdge& f) const {
    const auto [v0, v1, v2] = mesh_.vertices(f.triangle);
    const Vec3d a = mesh_.position(v0);
    const Vec3d normal = cross(mesh_.position(v1) - a, mesh_.position(v2) - a);
    const Vec3d edge = mesh_.position(f.b) - mesh_.position(f.a);
    const Vec3d across = normalized(cross(edge, normal));
    const double weight = squared_length(edge) * (f.is_border ? options_.boundary_weight : seam_weight) *
                          (options_.instance_weight ? options_.instance_weight(across) : 1);
    return plane_quadric(across, mesh_.position(f.a), weight);
}

void PlaneQuadrics::merge(uint32_t removed, uint32_t kept) {
    quadrics_[kept] += quadrics_[removed];
    weights_[kept] += weights_[removed];
    if (line_of_.empty() || line_of_[removed] == no_index) return;
    const Quadric line = lines_[line_of_[removed]];
    line_quadric(kept) += line;
}

void PlaneQuadrics::set_lines(uint32_t vertex, std::span<const FeatureEdge> edges) {
    Quadric& lines = line_quadric(vertex);
    lines = {};
    for (const FeatureEdge& edge : edges) lines += plane_of_line(edge);
}

PlaneError::PlaneError(const CollapseParts& parts, const PlaneOptions& options, const Watch& watch)
    : mesh_(parts.mesh), planes_(parts, options, watch) {}

std::optional<Placed> PlaneError::place(uint32_t removed, uint32_t kept, Freedom freedom, bool joins,
                                        const std::vector<uint32_t>& /*wedge_map*/) const {
    const Vec3d a = mesh_.position(removed), b = mesh_.position(kept);
    const Quadric q = planes_.sum(removed, kept);
    const Vec3d at = least_point(q, a, b, freedom);
    const double squared = joins ? planes_.sum_of_triangles(removed, kept)(at) : q(at);
    return Placed{at, squared + flat_preference * planes_.weight(removed, kept) * squared_length(a - b)};
}

void PlaneError::merge(uint32_t removed, uint32_t kept, const std::vector<uint32_t>& /*wedge_map*/) {
    planes_.merge(removed, kept);
}

}  // namespace coppice
