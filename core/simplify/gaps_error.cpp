#include "core/simplify/gaps_error.h"

#include <cmath>

#include "core/base/watched_loop.h"

namespace coppice {

GapsError::GapsError(const CollapseParts& parts, const PlaneOptions& options, const Watch& watch)
    : mesh_(parts.mesh),
      clouds_(parts.clouds),
      projection_(parts.projection),
      planes_(parts, options, watch),
      channels_(parts.clouds.channels()),
      weights_(size_t{parts.mesh.vertex_count()} * channels_, 0.0) {
    watched_loop(mesh_.vertex_count(), watch, [&](size_t i) {
        const auto v = static_cast<uint32_t>(i);
        for (uint32_t w = mesh_.wedge_begin(v); w < mesh_.wedge_end(v); ++w) {
            for (uint32_t k = 0; k < channels_; ++k) weights_[i * channels_ + k] += clouds_.weight(w, k);
        }
    });
}

std::optional<Placed> GapsError::place(uint32_t removed, uint32_t kept, Freedom freedom, bool joins,
                                       const std::vector<uint32_t>& wedge_map) const {
    const Vec3d a = mesh_.position(removed), b = mesh_.position(kept);
    const Quadric q = planes_.sum(removed, kept);
    const Vec3d at = least_point(q, a, b, freedom);
    const double area = planes_.weight(removed, kept);
    const double squared = joins ? planes_.sum_of_triangles(removed, kept)(at) : q(at);
    const double mean_square = (area > 0 ? squared / area : 0) + flat_preference * squared_length(a - b);
    double sum = area * std::sqrt(mean_square), weights = area;
    if (channels_ > 0) projection_.project(removed, kept, wedge_map, at);
    for (uint32_t k = 0; k < channels_; ++k) {
        const double x0 = weight(removed, k) + weight(kept, k);
        if (!(x0 > 0)) continue;
        weights += x0;
        sum += std::sqrt(x0 * squared_error(removed, kept, wedge_map, k));  // X0 A = X0 sqrt(Pi / X0)
    }
    return Placed{at, weights > 0 ? sum / weights : 0};
}

double GapsError::squared_error(uint32_t removed, uint32_t kept, const std::vector<uint32_t>& wedge_map,
                                uint32_t channel) const {
    // A wedge that no triangle has any more keeps the values it had.
    const auto at = [&](uint32_t from, uint32_t to) {
        const std::span<const WedgeShare> shares = projection_.shares(to);
        return shares.empty() ? clouds_.squared_error(from, to, channel)
                              : clouds_.squared_error(from, shares, channel);
    };
    double sum = 0;
    for (uint32_t w = mesh_.wedge_begin(kept); w < mesh_.wedge_end(kept); ++w) sum += at(w, w);
    const uint32_t first = mesh_.wedge_begin(removed);
    for (uint32_t i = 0; i < wedge_map.size(); ++i) {
        if (wedge_map[i] != no_index) sum += at(first + i, wedge_map[i]);
    }
    return sum;
}

void GapsError::merge(uint32_t removed, uint32_t kept, const std::vector<uint32_t>& wedge_map) {
    planes_.merge(removed, kept);
    for (uint32_t k = 0; k < channels_; ++k) weights_[size_t{kept} * channels_ + k] += weight(removed, k);
    const uint32_t first = mesh_.wedge_begin(removed);
    for (uint32_t i = 0; i < wedge_map.size(); ++i) {
        if (wedge_map[i] != no_index) clouds_.merge(first + i, wedge_map[i]);
    }
}

}  // namespace coppice
