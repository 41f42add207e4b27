#include "core/simplify/sphere_rule.h"

#include <algorithm>
#include <numeric>
#include <optional>

#include "core/base/watched_loop.h"

namespace coppice {

namespace {

// Balls of more vertices are cut: no contraction of more would pass.
constexpr size_t largest_ball = 64;

// Where A p = -b; none where planes do not meet in a point.
std::optional<Vec3d> optimum(const Quadric& q) {
    const Vec3d x = {q.xx, q.xy, q.xz}, y = {q.xy, q.yy, q.yz}, z = {q.xz, q.yz, q.zz};
    const Vec3d yz = cross(y, z), zx = cross(z, x), xy = cross(x, y);
    const double determinant = dot(x, yz), trace = q.xx + q.yy + q.zz;
    if (!(determinant > 1e-6 * trace * trace * trace)) return {};
    return (yz * q.bx + zx * q.by + xy * q.bz) * (-1 / determinant);
}

}  // namespace

void SphereRule::begin_round(const CollapseMesh& mesh, const Watch& watch) {
    diagonal_ = mesh.box().diagonal();
    gather_neighbours(mesh, watch);
    measure(mesh, watch);
}

// Each once, but for those beyond a border, which are only seen from the other side.
void SphereRule::gather_neighbours(const CollapseMesh& mesh, const Watch& watch) {
    begin_.assign(mesh.vertex_count() + 1, 0);
    neighbours_.clear();
    neighbours_.reserve(3 * size_t{mesh.live_triangles()} + mesh.live_vertices() / 8);
    watched_loop(mesh.vertex_count(), watch, [&](size_t v) {
        const auto first = static_cast<std::ptrdiff_t>(neighbours_.size());
        const auto vertex = static_cast<uint32_t>(v);
        uint64_t ahead = 0, behind = 0;
        for (uint32_t c = mesh.first_corner(vertex); c != no_index; c = mesh.corner_after(c)) {
            neighbours_.push_back(mesh.corner_vertex(CollapseMesh::next_corner(c)));
            ahead += neighbours_.back();
            behind += mesh.corner_vertex(CollapseMesh::previous_corner(c));
        }
        if (ahead != behind) {  // a border
            for (uint32_t c = mesh.first_corner(vertex); c != no_index; c = mesh.corner_after(c)) {
                const uint32_t n = mesh.corner_vertex(CollapseMesh::previous_corner(c));
                if (std::find(neighbours_.begin() + first, neighbours_.end(), n) == neighbours_.end())
                    neighbours_.push_back(n);
            }
        }
        begin_[v + 1] = static_cast<uint32_t>(neighbours_.size());
    });
}

void SphereRule::measure(const CollapseMesh& mesh, const Watch& watch) {
    quadrics_.assign(mesh.vertex_count(), Quadric{});
    std::vector<Vec3d> normals(mesh.vertex_count());
    double sum = 0;
    for_each_triangle(mesh, watch, [&](uint32_t, const std::array<uint32_t, 3>& v) {
        const Vec3d a = mesh.position(v[0]), b = mesh.position(v[1]), c = mesh.position(v[2]);
        const Vec3d normal = area_normal(a, b, c);
        const Quadric plane = plane_quadric(normalized(normal), a, length(normal));
        for (const uint32_t vertex : v) {
            normals[vertex] = normals[vertex] + normal;
            quadrics_[vertex] += plane;
        }
        sum += length(b - a) + length(c - b) + length(a - c);
    });
    mean_edge_ = mesh.live_triangles() > 0 ? sum / (3.0 * mesh.live_triangles()) : 0;
    places_.resize(mesh.vertex_count());
    for (uint32_t v = 0; v < mesh.vertex_count(); ++v)
        places_[v] = {to_float(mesh.position(v)), to_float(normalized(normals[v]))};
}

void SphereRule::offer(double radius, const Take& take) {
    radius_ = radius;
    taken_.assign(places_.size(), 0);
    for (uint32_t seed = 0; seed < places_.size(); ++seed) {
        if (taken_[seed] != 0 || begin_[seed] == begin_[seed + 1]) continue;
        fill_ball(seed, radius * radius);
        const size_t merged = ball_.size() > 1 ? take(ball_) : 0;
        // Members of a refused ball may still be in another one.
        for (size_t i = 0; i < ball_.size(); ++i) taken_[ball_[i]] = i < merged || i == 0 ? 1 : 0;
    }
}

// Breadth first, so that a part from the front is connected too.
void SphereRule::fill_ball(uint32_t seed, double squared_radius) {
    const Place centre = places_[seed];
    const auto limit = static_cast<float>(std::min(squared_radius, 1e30));
    ball_.assign(1, seed);
    taken_[seed] = 1;
    for (size_t next = 0; next < ball_.size() && ball_.size() < largest_ball; ++next) {
        for (uint32_t i = begin_[ball_[next]]; i < begin_[ball_[next] + 1]; ++i) {
            const uint32_t v = neighbours_[i];
            if (taken_[v] != 0) continue;
            const Place& p = places_[v];
            const Vec3f away = p.position - centre.position;
            if (away.x * away.x + away.y * away.y + away.z * away.z > limit) continue;
            const float facing =
                p.normal.x * centre.normal.x + p.normal.y * centre.normal.y + p.normal.z * centre.normal.z;
            if (!(facing > 0)) continue;
            taken_[v] = 1;
            ball_.push_back(v);
            if (ball_.size() == largest_ball) return;
        }
    }
}

Placement SphereRule::place(const CollapseMesh& mesh, std::span<const uint32_t> vertices) {
    Quadric sum;
    Vec3d centroid;
    const double part = 1.0 / static_cast<double>(vertices.size());
    for (const uint32_t v : vertices) {
        sum += quadrics_[v];
        centroid = centroid + mesh.position(v) * part;
    }
    const Vec3d seed = mesh.position(vertices.front());
    Vec3d point = centroid;
    weights_.assign(vertices.size(), part);
    double error = sum(centroid);
    if (const double there = sum(seed); there < error) {
        error = there;
        point = seed;
        weights_.assign(vertices.size(), 0);
        weights_.front() = 1;
    }
    const std::optional<Vec3d> best = optimum(sum);
    if (!best || squared_length(*best - seed) > radius_ * radius_ || !(sum(*best) < error))
        return {point, weights_};
    double total = 0;
    for (size_t i = 0; i < vertices.size(); ++i) {
        weights_[i] = 1 / (squared_length(mesh.position(vertices[i]) - *best) + 1e-6 * radius_ * radius_);
        total += weights_[i];
    }
    for (double& weight : weights_) weight /= total;
    return {*best, weights_};
}

}  // namespace coppice
