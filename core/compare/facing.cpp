#include "core/compare/facing.h"

#include <algorithm>
#include <optional>
#include <vector>

#include "core/base/watched_parallel.h"
#include "core/compare/attributes.h"

namespace coppice {

namespace {

constexpr double as_near = 1e-6;  // of the diagonal
constexpr std::array<std::array<double, 3>, 7> places = {{{1, 0, 0},
                                                          {0, 1, 0},
                                                          {0, 0, 1},
                                                          {1.0 / 3, 1.0 / 3, 1.0 / 3},
                                                          {2.0 / 3, 1.0 / 6, 1.0 / 6},
                                                          {1.0 / 6, 2.0 / 3, 1.0 / 6},
                                                          {1.0 / 6, 1.0 / 6, 2.0 / 3}}};

double sign(double value) {
    return value > 0 ? 1 : (value < 0 ? -1 : 0);
}

double orientation_in_texture(const Surface& surface, uint32_t triangle) {
    if ((surface.has[triangle] & Surface::has_texture) == 0) return 0;
    return sign(texture_area(surface, triangle));
}

// What the reference says at one place.
struct Vote {
    double cosine = 0;
    double texture = 0;  // -1, 0, 1
};

Vote vote_at(const SearchedSurface& reference, Vec3d place, Vec3d unit_normal, uint32_t& hint) {
    const Bvh::Nearest nearest = reference.bvh.nearest(place, hint);
    hint = nearest.triangle;
    const double radius = nearest.distance() * (1 + as_near) + as_near * reference.diagonal;
    std::optional<Vote> best;
    reference.bvh.visit_within(place, radius * radius, [&](uint32_t triangle, const TrianglePoint&) {
        const Vec3d normal = normalized(reference.surface.facet_normal(triangle));
        const double cosine = dot(normal, unit_normal);
        if (squared_length(normal) > 0 && (!best || cosine > best->cosine))
            best = {cosine, orientation_in_texture(reference.surface, triangle)};
    });
    return best.value_or(Vote{});
}

void count_flip(const SearchedSurface& reference, const Surface& candidate, uint32_t triangle, uint32_t& hint,
                Flips& flips) {
    const Vec3d normal = normalized(candidate.facet_normal(triangle));
    if (!(squared_length(normal) > 0)) return;
    const auto [a, b, c] = candidate.corners(triangle);
    const double texture = orientation_in_texture(candidate, triangle);
    double cosines = 0, agreement = 0;
    for (const auto& weights : places) {
        const Vote vote = vote_at(reference, interpolate(weights, a, b, c), normal, hint);
        cosines += vote.cosine;
        // One that faces the other way shows its texture from behind.
        agreement += texture * vote.texture * sign(vote.cosine);
    }
    flips.triangles += cosines < 0 ? 1 : 0;
    flips.texture_triangles += agreement < 0 ? 1 : 0;
}

}  // namespace

Flips count_flips(const SearchedSurface& reference, const Surface& candidate, unsigned threads,
                  const Watch& watch) {
    constexpr size_t per_chunk = 256;
    const size_t count = candidate.triangle_count();
    std::vector<Flips> of_chunk((count + per_chunk - 1) / per_chunk);
    watched_parallel_for(of_chunk.size(), threads, watch, [&](size_t chunk) {
        uint32_t hint = Bvh::none;
        const size_t end = std::min(count, (chunk + 1) * per_chunk);
        for (size_t t = chunk * per_chunk; t < end; ++t) {
            if (t % 8 == 0) watch.check();
            count_flip(reference, candidate, static_cast<uint32_t>(t), hint, of_chunk[chunk]);
        }
    });
    Flips sum;
    for (const Flips& flips : of_chunk) {
        sum.triangles += flips.triangles;
        sum.texture_triangles += flips.texture_triangles;
    }
    return sum;
}

}  // namespace coppice
