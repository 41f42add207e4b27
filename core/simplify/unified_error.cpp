#include "core/simplify/unified_error.h"

#include <cmath>

#include "core/base/watched_loop.h"

namespace coppice {

namespace {

constexpr double border_weight = 10;  // of a plane across a border, relative to that of a triangle of edge^2
constexpr double seam_weight = 1;     // for each side

}  // namespace

UnifiedError::UnifiedError(const CollapseParts& parts, const UnifiedOptions& options, const Watch& watch)
    : mesh_(parts.mesh),
      clouds_(parts.clouds),
      weights_(options.weights),
      max_geometric_error_(options.max_geometric_error),
      geometry_(watched_vector<Geometry>(mesh_.vertex_count(), watch)),
      spread_(watched_vector<Spread>(size_t{mesh_.vertex_count()} * clouds_.channels(), watch)) {
    const InstanceMetric metric(options.instances);
    add_planes(metric, watch);
    if (weights_ == PlaneWeights::area) add_constraints(parts.features, metric, watch);
    watched_loop(mesh_.vertex_count(), watch, [&](size_t i) {
        const auto v = static_cast<uint32_t>(i);
        for (uint32_t w = mesh_.wedge_begin(v); w < mesh_.wedge_end(v); ++w) {
            for (uint32_t k = 0; k < clouds_.channels(); ++k) {
                spread_[size_t{v} * clouds_.channels() + k].weight += clouds_.weight(w, k);
            }
        }
    });
}

// In the mean instance an area is times `shrink`, a distance to its plane is divided by that.
void UnifiedError::add_planes(const InstanceMetric& metric, const Watch& watch) {
    for_each_triangle(mesh_, watch, [&](uint32_t, const std::array<uint32_t, 3>& v) {
        const Vec3d a = mesh_.position(v[0]);
        const Vec3d twice_area = area_normal(a, mesh_.position(v[1]), mesh_.position(v[2]));
        const double area = 0.5 * length(twice_area);
        if (!(area > 0)) return;
        const Vec3d normal = normalized(twice_area);
        const double shrink = weights_ == PlaneWeights::area ? metric.shrink(normal) : 1;
        const double weight = weights_ == PlaneWeights::area ? area * shrink : 1;
        const Quadric plane = plane_quadric(normal, a, weight / (shrink * shrink));
        for (const uint32_t vertex : v) {
            geometry_[vertex].quadric += plane;
            geometry_[vertex].plane_weight += weight;
            geometry_[vertex].area += area;
        }
    });
}

// Planes through border and seam edges, perpendicular to the triangle in the mean instance, where edges are
// as long as they are there.
void UnifiedError::add_constraints(std::span<const FeatureEdge> features, const InstanceMetric& metric,
                                   const Watch& watch) {
    watched_loop(features.size(), watch, [&](size_t i) {
        const FeatureEdge& f = features[i];
        const Vec3d a = mesh_.position(mesh_.corner_vertex(3 * f.triangle));
        const Vec3d normal = cross(mesh_.position(mesh_.corner_vertex(3 * f.triangle + 1)) - a,
                                   mesh_.position(mesh_.corner_vertex(3 * f.triangle + 2)) - a);
        const Vec3d edge = mesh_.position(f.b) - mesh_.position(f.a);
        const Vec3d inward = cross(metric.dual(edge), normal);  // in the triangle, away from the edge
        const Vec3d across = metric.dual(inward);
        const double size = std::sqrt(dot(inward, across));
        const double weight = dot(edge, metric.dual(edge)) * (f.is_border ? border_weight : seam_weight);
        const Quadric plane =
            plane_quadric(size > 0 ? across * (1 / size) : Vec3d{}, mesh_.position(f.a), weight);
        geometry_[f.a].quadric += plane;
        geometry_[f.b].quadric += plane;
    });
}

std::optional<Placed> UnifiedError::place(uint32_t removed, uint32_t kept, Freedom /*freedom*/,
                                          bool /*joins*/, const std::vector<uint32_t>& wedge_map) const {
    const Cost pair = cost(removed, kept, wedge_map);
    if (max_geometric_error_ && pair.geometric > *max_geometric_error_) return {};
    return Placed{mesh_.position(kept), pair.unified};
}

UnifiedError::Cost UnifiedError::cost(uint32_t removed, uint32_t kept,
                                      const std::vector<uint32_t>& wedge_map) const {
    const Vec3d p = mesh_.position(kept);
    const Geometry &from = geometry_[removed], &to = geometry_[kept];
    const double planes = from.plane_weight + to.plane_weight;
    double mean_square = planes > 0 ? (from.quadric(p) + to.quadric(p)) / planes : 0;
    if (weights_ == PlaneWeights::area) {
        mean_square += flat_preference * squared_length(mesh_.position(removed) - p);
    }
    Cost cost;
    cost.geometric = std::sqrt(mean_square);

    double weight = from.area + to.area;
    double sum = weight * cost.geometric;
    const uint32_t channels = clouds_.channels();
    for (uint32_t k = 0; k < channels; ++k) {
        const Spread& mine = spread_[size_t{removed} * channels + k];
        const Spread& its = spread_[size_t{kept} * channels + k];
        const double x0 = mine.weight + its.weight;
        if (!(x0 > 0)) continue;
        const double squared = its.squared + gathered_error(removed, wedge_map, k);
        weight += x0;
        sum += std::sqrt(x0 * squared);  // X0 A = X0 sqrt(Pi / X0)
    }
    cost.unified = weight > 0 ? sum / weight : 0;
    return cost;
}

// Pi of all clouds of the vertex that goes, each at the wedge that takes its place.
double UnifiedError::gathered_error(uint32_t removed, const std::vector<uint32_t>& wedge_map,
                                    uint32_t channel) const {
    double sum = 0;
    const uint32_t first = mesh_.wedge_begin(removed);
    for (uint32_t i = 0; i < wedge_map.size(); ++i) {
        if (wedge_map[i] != no_index) sum += clouds_.squared_error(first + i, wedge_map[i], channel);
    }
    return sum;
}

void UnifiedError::merge(uint32_t removed, uint32_t kept, const std::vector<uint32_t>& wedge_map) {
    const uint32_t channels = clouds_.channels();
    for (uint32_t k = 0; k < channels; ++k) {
        Spread& its = spread_[size_t{kept} * channels + k];
        its.squared += gathered_error(removed, wedge_map, k);
        its.weight += spread_[size_t{removed} * channels + k].weight;
    }
    const uint32_t first = mesh_.wedge_begin(removed);
    for (uint32_t i = 0; i < wedge_map.size(); ++i) {
        if (wedge_map[i] != no_index) clouds_.merge(first + i, wedge_map[i]);
    }
    geometry_[kept].quadric += geometry_[removed].quadric;
    geometry_[kept].plane_weight += geometry_[removed].plane_weight;
    geometry_[kept].area += geometry_[removed].area;
}

}  // namespace coppice
