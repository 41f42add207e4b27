#include "core/compare/deviation.h"

#include <algorithm>
#include <cmath>

#include "core/base/watched_loop.h"
#include "core/base/watched_parallel.h"
#include "core/compare/attributes.h"

namespace coppice {

namespace {

constexpr uint64_t samples_per_chunk = 1024;
constexpr uint64_t most_chunks = 256;  // sums are put together in their order
constexpr uint64_t samples_per_edge_sample = 5;
constexpr double as_near = 1e-6;        // of the diagonal
constexpr double around_a_seam = 0.01;  // of the diagonal
constexpr double distance_weight = 4;

// Keeps the least of what it is told.
class Least {
  public:
    void consider(double value) { value_ = value_ ? std::min(*value_, value) : value; }
    void consider(std::optional<double> value) {
        if (value) consider(*value);
    }
    const std::optional<double>& value() const { return value_; }

  private:
    std::optional<double> value_;
};

// A point of the surface that is measured.
class Probe {
  public:
    Probe(const Surface& from, const SearchedSurface& to, const SurfaceSample& sample)
        : from_(from), to_(to), sample_(sample), facet_(from.facet_normal(sample.triangle)) {
        const uint8_t has = from.has[sample.triangle];
        if ((has & Surface::has_normals) != 0) normal_ = normal_at(from, sample.triangle, sample.weights);
        if ((has & Surface::has_texture) != 0)
            texture_ = value_at(from, from.texture, sample.triangle, sample.weights);
        if ((has & Surface::has_colors) != 0)
            color_ = value_at(from, from.colors, sample.triangle, sample.weights);
    }

    Vec3d position() const {
        const auto [a, b, c] = from_.corners(sample_.triangle);
        return interpolate(sample_.weights, a, b, c);
    }

    std::optional<double> facet_angle(uint32_t triangle) const {
        return angle_between(facet_, to_.surface.facet_normal(triangle));
    }
    std::optional<double> normal_angle(uint32_t triangle, const TrianglePoint& at) const {
        if (!normal_ || (to_.surface.has[triangle] & Surface::has_normals) == 0) return {};
        return angle_between(*normal_, normal_at(to_.surface, triangle, at.weights));
    }
    std::optional<double> texture_difference(uint32_t triangle, const TrianglePoint& at) const {
        if (!texture_ || (to_.surface.has[triangle] & Surface::has_texture) == 0) return {};
        return difference(*texture_, value_at(to_.surface, to_.surface.texture, triangle, at.weights));
    }
    std::optional<double> color_difference(uint32_t triangle, const TrianglePoint& at) const {
        if (!color_ || (to_.surface.has[triangle] & Surface::has_colors) == 0) return {};
        return difference(*color_, value_at(to_.surface, to_.surface.colors, triangle, at.weights));
    }

    // How much the texture is denser here than on average, at least 1.
    double texture_density(double texture_scale) const {
        const double area = length(facet_), in_texture = std::abs(texture_area(from_, sample_.triangle));
        return area > 0 ? std::max(1.0, texture_scale * std::sqrt(in_texture / area)) : 1.0;
    }

  private:
    const Surface& from_;
    const SearchedSurface& to_;
    SurfaceSample sample_;
    Vec3d facet_;
    std::optional<Vec3d> normal_;
    std::optional<std::array<double, 2>> texture_;
    std::optional<std::array<double, 4>> color_;
};

class Measure {
  public:
    Measure(const Surface& from, const SearchedSurface& to, double texture_scale)
        : from_(from), to_(to), texture_scale_(texture_scale) {}

    void add(const SurfaceSample& sample, double weight, uint32_t& hint, Deviation& sums) const {
        const Probe probe(from_, to_, sample);
        const Vec3d position = probe.position();
        const Bvh::Nearest nearest = to_.bvh.nearest(position, hint);
        hint = nearest.triangle;
        const double distance = nearest.distance();
        sums.distance.add(distance, weight);

        const double ties = distance * (1 + as_near) + as_near * to_.diagonal;
        const auto texture = probe.texture_difference(nearest.triangle, nearest.point);
        const double per_length =
            texture ? distance_weight * probe.texture_density(texture_scale_) : distance_weight;
        const double radius = std::max(ties, seam_radius(distance, texture, per_length));

        Least facet, normal, color;
        double cost = std::numeric_limits<double>::infinity();
        std::optional<double> on_this_side;
        to_.bvh.visit_within(position, radius * radius, [&](uint32_t triangle, const TrianglePoint& at) {
            const double away = std::sqrt(at.squared_distance);
            if (away <= ties) {
                facet.consider(probe.facet_angle(triangle));
                normal.consider(probe.normal_angle(triangle, at));
                color.consider(probe.color_difference(triangle, at));
            }
            const auto difference = probe.texture_difference(triangle, at);
            if (!difference) return;
            const double its_cost = per_length * away + texture_scale_ * *difference;
            if (its_cost < cost) {
                cost = its_cost;
                on_this_side = difference;
            }
        });
        if (facet.value()) sums.facets.add(*facet.value(), weight);
        if (normal.value()) sums.normals.add(*normal.value(), weight);
        if (color.value()) sums.colors.add(*color.value(), weight);
        if (on_this_side) sums.texture.add(*on_this_side, weight);
    }

    void add_largest(Vec3d position, uint32_t& hint, Deviation& sums) const {
        const Bvh::Nearest nearest = to_.bvh.nearest(position, hint);
        hint = nearest.triangle;
        sums.distance.add_largest(nearest.distance());
    }

  private:
    // No farther can a point be that costs less than the nearest one.
    double seam_radius(double distance, const std::optional<double>& texture, double per_length) const {
        if (!texture) return 0;
        return std::min(distance + texture_scale_ * *texture / per_length,
                        distance + around_a_seam * to_.diagonal);
    }

    const Surface& from_;
    const SearchedSurface& to_;
    double texture_scale_;
};

// Where a chunk begins among `count` things that are shared out.
uint64_t begin_of(uint64_t chunk, uint64_t chunks, uint64_t count) {
    return count / chunks * chunk + std::min(chunk, count % chunks);
}

}  // namespace

void Deviation::add(const Deviation& other) {
    distance.add(other.distance);
    facets.add(other.facets);
    normals.add(other.normals);
    texture.add(other.texture);
    colors.add(other.colors);
}

Deviation measure_deviation(const Surface& from, const SearchedSurface& to, double texture_scale,
                            const Sampling& sampling, unsigned threads, const Watch& watch) {
    const AreaSamples on_area(from, sampling.count, sampling.seed, watch);
    const EdgeSamples on_edges(from, sampling.count / samples_per_edge_sample, sampling.seed, watch);
    const Measure measure(from, to, texture_scale);
    // A sample stands for as much area as any other.
    const double weight = (on_area.area() > 0 ? on_area.area() : 1) / static_cast<double>(on_area.count());

    // By the number of samples, never of threads.
    const uint64_t chunks = std::clamp<uint64_t>(on_area.count() / samples_per_chunk, 1, most_chunks);
    std::vector<Deviation> of_chunk(chunks);
    watched_parallel_for(chunks, threads, watch, [&](size_t chunk) {
        Deviation& sums = of_chunk[chunk];
        uint32_t hint = Bvh::none;
        uint32_t looked = 0;
        const auto look = [&] {
            if ((++looked & 0xFU) == 0) watch.check();
        };
        on_area.visit(begin_of(chunk, chunks, on_area.count()), begin_of(chunk + 1, chunks, on_area.count()),
                      [&](const SurfaceSample& sample) {
                          look();
                          measure.add(sample, weight, hint, sums);
                      });
        on_edges.visit(begin_of(chunk, chunks, on_edges.count()),
                       begin_of(chunk + 1, chunks, on_edges.count()), [&](Vec3d position) {
                           look();
                           measure.add_largest(position, hint, sums);
                       });
        const uint64_t end = begin_of(chunk + 1, chunks, from.positions.size());
        for (uint64_t v = begin_of(chunk, chunks, from.positions.size()); v < end; ++v) {
            look();
            measure.add_largest(from.positions[v], hint, sums);
        }
    });
    Deviation all;
    for (const Deviation& sums : of_chunk) all.add(sums);
    return all;
}

double texture_scale(const Surface& surface, const Watch& watch) {
    double area = 0, in_texture = 0;
    watched_loop(surface.triangle_count(), watch, [&](size_t t) {
        if ((surface.has[t] & Surface::has_texture) == 0) return;
        area += length(surface.facet_normal(t));
        in_texture += std::abs(texture_area(surface, t));
    });
    return in_texture > 0 ? std::sqrt(area / in_texture) : 0;
}

}  // namespace coppice
