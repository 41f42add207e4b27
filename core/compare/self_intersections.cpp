#include "core/compare/self_intersections.h"

#include <algorithm>
#include <atomic>
#include <numeric>
#include <vector>

#include "core/base/watched_parallel.h"
#include "core/compare/triangle_contact.h"

namespace coppice {

namespace {

TriangleCorners float_corners(const Surface& surface, uint32_t triangle) {
    const auto [a, b, c] = surface.corners(triangle);
    return {to_float(a), to_float(b), to_float(c)};
}

class Search {
  public:
    Search(const Surface& surface, const Bvh& bvh, const Watch& watch)
        : surface_(surface), bvh_(bvh), watch_(watch), is_in_a_pair_(surface.triangle_count(), 0) {}

    // How many triangles after this one it meets. From any thread.
    uint64_t look_at(uint32_t triangle) {
        watch_.check();
        const TriangleCorners corners = float_corners(surface_, triangle);
        if (is_flat(corners)) return 0;
        uint64_t met = 0;
        uint32_t looked = 0;
        bvh_.visit_meeting(triangle, [&](uint32_t other) {
            if ((++looked & 0xFFFU) == 0) watch_.check();
            const TriangleCorners others = float_corners(surface_, other);
            if (is_flat(others) || !meet_elsewhere(corners, others)) return;
            ++met;
            mark(other);
        });
        if (met > 0) mark(triangle);
        return met;
    }

    uint64_t triangles() const {
        return static_cast<uint64_t>(std::count(is_in_a_pair_.begin(), is_in_a_pair_.end(), 1));
    }

  private:
    // Several threads may say so of one triangle; they say the same.
    void mark(uint32_t triangle) {
        std::atomic_ref<uint8_t>(is_in_a_pair_[triangle]).store(1, std::memory_order_relaxed);
    }

    const Surface& surface_;
    const Bvh& bvh_;
    const Watch& watch_;
    std::vector<uint8_t> is_in_a_pair_;
};

}  // namespace

SelfIntersections find_self_intersections(const Surface& surface, const Bvh& bvh, unsigned threads,
                                          const Watch& watch) {
    constexpr size_t per_chunk = 64;
    const size_t count = surface.triangle_count();
    std::vector<uint64_t> pairs((count + per_chunk - 1) / per_chunk, 0);
    Search search(surface, bvh, watch);
    watched_parallel_for(pairs.size(), threads, watch, [&](size_t chunk) {
        const size_t end = std::min(count, (chunk + 1) * per_chunk);
        for (size_t t = chunk * per_chunk; t < end; ++t)
            pairs[chunk] += search.look_at(static_cast<uint32_t>(t));
    });
    return {std::accumulate(pairs.begin(), pairs.end(), uint64_t{0}), search.triangles()};
}

}  // namespace coppice
