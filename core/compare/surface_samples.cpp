#include "core/compare/surface_samples.h"

#include <algorithm>
#include <cmath>

#include "core/base/watched_loop.h"

namespace coppice {

namespace {

// Number `i` of a sequence that the seed names, in [0, 1). A finalizer instead of a generator with a state:
// any thread can begin anywhere. SplitMix64, Steele, Lea and Flood 2014.
double random_number(uint64_t seed, uint64_t i) {
    uint64_t z = (seed * 0xd1342543de82ef95ULL + i + 1) * 0x9e3779b97f4a7c15ULL;
    z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9ULL;
    z = (z ^ (z >> 27)) * 0x94d049bb133111ebULL;
    z ^= z >> 31;
    return static_cast<double>(z >> 11) * 0x1p-53;
}

// The triangle whose part of ends holds the place.
uint32_t find_part(const std::vector<double>& ends, double place) {
    const auto found = std::upper_bound(ends.begin(), ends.end(), place);
    return static_cast<uint32_t>(
        std::min<size_t>(static_cast<size_t>(found - ends.begin()), ends.size() - 1));
}

void advance(const std::vector<double>& ends, double place, uint32_t& triangle) {
    while (triangle + 1 < ends.size() && ends[triangle] <= place) ++triangle;
}

std::array<double, 3> edge_lengths(const Surface& surface, size_t triangle) {
    const auto [a, b, c] = surface.corners(triangle);
    return {length(b - a), length(c - b), length(a - c)};
}

template <typename Size>
std::vector<double> cumulate(size_t count, const Watch& watch, Size size) {
    std::vector<double> ends(count);
    double sum = 0;
    watched_loop(count, watch, [&](size_t t) { ends[t] = sum += size(t); });
    return ends;
}

}  // namespace

AreaSamples::AreaSamples(const Surface& surface, uint64_t count, uint64_t seed, const Watch& watch)
    : count_(count), seed_(seed) {
    const size_t triangles = surface.triangle_count();
    ends_ = cumulate(triangles, watch, [&](size_t t) { return length(surface.facet_normal(t)) / 2; });
    area_ = ends_.back();
    if (!(area_ > 0)) ends_ = cumulate(triangles, watch, [](size_t) { return 1.0; });
}

double AreaSamples::place(uint64_t sample) const {
    const double part = (static_cast<double>(sample) + random_number(seed_, 3 * sample));
    return part / static_cast<double>(count_) * ends_.back();
}

uint32_t AreaSamples::triangle_at(uint64_t sample) const {
    return find_part(ends_, place(sample));
}

SurfaceSample AreaSamples::next(uint64_t sample, uint32_t& triangle) const {
    advance(ends_, place(sample), triangle);
    // Uniform over a triangle: Turk 1990.
    const double root = std::sqrt(random_number(seed_, 3 * sample + 1));
    const double share = random_number(seed_, 3 * sample + 2);
    return {triangle, {1 - root, root * (1 - share), root * share}};
}

EdgeSamples::EdgeSamples(const Surface& surface, uint64_t count, uint64_t seed, const Watch& watch)
    : surface_(surface), count_(count), seed_(~seed) {
    ends_ = cumulate(surface.triangle_count(), watch, [&](size_t t) {
        const std::array<double, 3> lengths = edge_lengths(surface, t);
        return lengths[0] + lengths[1] + lengths[2];
    });
    if (!(ends_.back() > 0)) count_ = 0;
}

double EdgeSamples::place(uint64_t sample) const {
    const double part = (static_cast<double>(sample) + random_number(seed_, sample));
    return part / static_cast<double>(count_) * ends_.back();
}

uint32_t EdgeSamples::triangle_at(uint64_t sample) const {
    return find_part(ends_, place(sample));
}

Vec3d EdgeSamples::next(uint64_t sample, uint32_t& triangle) const {
    const double at = place(sample);
    advance(ends_, at, triangle);
    const std::array<double, 3> lengths = edge_lengths(surface_, triangle);
    double along = at - (triangle == 0 ? 0 : ends_[triangle - 1]);
    size_t edge = 0;
    while (edge < 2 && along > lengths[edge]) along -= lengths[edge++];
    const double share = lengths[edge] > 0 ? std::clamp(along / lengths[edge], 0.0, 1.0) : 0;
    return surface_.corner(triangle, edge) * (1 - share) + surface_.corner(triangle, (edge + 1) % 3) * share;
}

}  // namespace coppice
