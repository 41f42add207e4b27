#include "core/compare/distance_bounds.h"

#include <algorithm>
#include <vector>

#include "core/base/watched_parallel.h"

namespace coppice {

namespace {

struct Corner {
    Vec3d position;
    Bvh::Nearest nearest;
};

using Patch = std::array<Corner, 3>;

// Looks at one triangle after another. `lower` is what is known before, so that no thread depends on another.
class PatchSearch {
  public:
    PatchSearch(const Surface& to, const Bvh& bvh, double lower, double tolerance, const Watch& watch)
        : to_(to), bvh_(bvh), tolerance_(tolerance), watch_(watch), bounds_{lower, lower} {}

    void look_at(const std::array<Vec3d, 3>& corners) {
        stack_ = {{corner(corners[0]), corner(corners[1]), corner(corners[2])}};
        while (!stack_.empty()) {
            const Patch patch = stack_.back();
            stack_.pop_back();
            const double above = bound(patch);
            if (above <= bounds_.lower + tolerance_ || is_a_point(patch)) {
                bounds_.upper = std::max(bounds_.upper, above);
            } else {
                split(patch);
            }
        }
    }

    DistanceBounds bounds() const { return {bounds_.lower, std::max(bounds_.lower, bounds_.upper)}; }

  private:
    Corner corner(Vec3d position) {
        if ((++looked_ & 0xFU) == 0) watch_.check();
        const Corner made = {position, bvh_.nearest(position, hint_)};
        hint_ = made.nearest.triangle;
        bounds_.lower = std::max(bounds_.lower, made.nearest.distance());
        return made;
    }

    double bound(const Patch& patch) {
        const Corner middle = corner((patch[0].position + patch[1].position + patch[2].position) * (1.0 / 3));
        double radius = 0;
        for (const Corner& of : patch) radius = std::max(radius, length(of.position - middle.position));
        // A distance changes by no more than one has moved.
        double least = middle.nearest.distance() + radius;
        for (const uint32_t triangle : {middle.nearest.triangle, patch[0].nearest.triangle,
                                        patch[1].nearest.triangle, patch[2].nearest.triangle}) {
            least = std::min(least, farthest_corner(patch, triangle));
        }
        return least;
    }

    double farthest_corner(const Patch& patch, uint32_t triangle) const {
        const auto [a, b, c] = to_.corners(triangle);
        double squared = 0;
        for (const Corner& of : patch)
            squared = std::max(squared, closest_point(of.position, a, b, c).squared_distance);
        return std::sqrt(squared);
    }

    // Halving it further changes nothing that a double could hold.
    static bool is_a_point(const Patch& patch) {
        const Vec3d middle = (patch[0].position + patch[1].position) * 0.5;
        const Vec3d other = (patch[0].position + patch[2].position) * 0.5;
        const auto is_end = [&](Vec3d p, size_t end) {
            return p == patch[0].position || p == patch[end].position;
        };
        return is_end(middle, 1) && is_end(other, 2);
    }

    void split(const Patch& patch) {
        const auto middle = [&](size_t i, size_t j) {
            return corner((patch[i].position + patch[j].position) * 0.5);
        };
        const Corner ab = middle(0, 1), bc = middle(1, 2), ca = middle(2, 0);
        stack_.push_back({ab, bc, ca});
        stack_.push_back({patch[0], ab, ca});
        stack_.push_back({ab, patch[1], bc});
        stack_.push_back({ca, bc, patch[2]});
    }

    const Surface& to_;
    const Bvh& bvh_;
    double tolerance_;
    const Watch& watch_;
    DistanceBounds bounds_;
    std::vector<Patch> stack_;  // three for each halving: a few hundred at most
    uint32_t hint_ = Bvh::none;
    uint32_t looked_ = 0;
};

// What the vertices reach.
double reached(const Surface& from, const Bvh& to, unsigned threads, const Watch& watch) {
    constexpr size_t per_chunk = 256;
    const size_t count = from.positions.size();
    std::vector<double> of_chunk((count + per_chunk - 1) / per_chunk, 0.0);
    watched_parallel_for(of_chunk.size(), threads, watch, [&](size_t chunk) {
        const size_t end = std::min(count, (chunk + 1) * per_chunk);
        for (size_t v = chunk * per_chunk; v < end; ++v) {
            if (v % 16 == 0) watch.check();
            of_chunk[chunk] = std::max(of_chunk[chunk], to.nearest(from.positions[v]).distance());
        }
    });
    return *std::max_element(of_chunk.begin(), of_chunk.end());
}

}  // namespace

DistanceBounds distance_bounds(const Surface& from, const Bvh& to, double tolerance, unsigned threads,
                               const Watch& watch) {
    constexpr size_t per_chunk = 64;
    const double lower = reached(from, to, threads, watch.part(0, 0.2));
    const size_t count = from.triangle_count();
    std::vector<DistanceBounds> of_chunk((count + per_chunk - 1) / per_chunk);
    watched_parallel_for(of_chunk.size(), threads, watch.part(0.2, 1), [&](size_t chunk) {
        PatchSearch search(to.surface(), to, lower, tolerance, watch);
        const size_t end = std::min(count, (chunk + 1) * per_chunk);
        for (size_t t = chunk * per_chunk; t < end; ++t) search.look_at(from.corners(t));
        of_chunk[chunk] = search.bounds();
    });
    DistanceBounds all = {lower, lower};
    for (const DistanceBounds& bounds : of_chunk) {
        all.lower = std::max(all.lower, bounds.lower);
        all.upper = std::max(all.upper, bounds.upper);
    }
    return all;
}

}  // namespace coppice
