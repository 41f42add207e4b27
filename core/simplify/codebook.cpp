#include "core/simplify/codebook.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>

namespace coppice {

namespace {

// A point of a cube's face: face / 2 is its axis, odd ones are on the negative side; u and v, -1..1, run
// along the next two axes.
Vec3d on_cube(uint32_t face, double u, double v) {
    const double side = face % 2 == 0 ? 1 : -1;
    switch (face / 2) {
        case 0:
            return {side, u, v};
        case 1:
            return {v, side, u};
        default:
            return {u, v, side};
    }
}

struct OnCube {
    uint32_t face = 0;
    double u = 0, v = 0;
};

OnCube to_cube(Vec3d d) {
    const double x = std::abs(d.x), y = std::abs(d.y), z = std::abs(d.z);
    if (x >= y && x >= z) return {d.x < 0 ? 1U : 0U, d.y / x, d.z / x};
    if (y >= z) return {d.y < 0 ? 3U : 2U, d.z / y, d.x / y};
    return {d.z < 0 ? 5U : 4U, d.x / z, d.y / z};
}

double grid_line(uint32_t i, uint32_t cells, Warp warp) {
    const double even = -1 + 2.0 * i / cells;
    return warp == Warp::flat ? even : std::tan(even * std::numbers::pi / 4);
}

// Those of `from` that may be nearest to a direction within `radius` of the centre: none of the others is
// nearer to any such direction than the one nearest to the centre.
void append_near(Vec3d centre, double radius, std::span<const uint32_t> from,
                 const std::vector<Vec3d>& vectors, std::vector<uint32_t>& out) {
    constexpr double rounding = 1e-7;
    double most = -1;
    for (const uint32_t i : from) most = std::max(most, dot(centre, vectors[i]));
    const double reach = std::acos(std::min(most, 1.0)) + 2 * radius + rounding;
    const double least = reach < std::numbers::pi ? std::cos(reach) : -2;
    for (const uint32_t i : from)
        if (dot(centre, vectors[i]) >= least) out.push_back(i);
}

}  // namespace

uint64_t code_vector_count(const CodebookSizes& sizes) {
    const uint64_t x = sizes[0], y = sizes[1], z = sizes[2];
    return 2 * (x * y + y * z + z * x);
}

Codebook::Codebook(const CodebookSizes& sizes, Warp warp, uint64_t lookups, const Watch& watch) {
    add_vectors(sizes, warp);
    begins_ = {0};
    std::vector<uint32_t> all(vectors_.size());
    std::iota(all.begin(), all.end(), 0U);
    for (uint32_t face = 0; face < 6; ++face) {
        candidates_.insert(candidates_.end(), all.begin(), all.end());
        begins_.push_back(static_cast<uint32_t>(candidates_.size()));
    }
    const uint32_t finest = 2 * *std::max_element(sizes.begin(), sizes.end());
    while (resolution_ < finest && 96 * uint64_t{resolution_} * resolution_ < lookups) split_cells(watch);
}

// The normal of a quad is across its diagonals.
void Codebook::add_vectors(const CodebookSizes& sizes, Warp warp) {
    for (uint32_t face = 0; face < 6; ++face) {
        const uint32_t cells_u = sizes[(face / 2 + 1) % 3], cells_v = sizes[(face / 2 + 2) % 3];
        for (uint32_t i = 0; i < cells_u; ++i) {
            for (uint32_t j = 0; j < cells_v; ++j) {
                const auto corner = [&](uint32_t di, uint32_t dj) {
                    return normalized(
                        on_cube(face, grid_line(i + di, cells_u, warp), grid_line(j + dj, cells_v, warp)));
                };
                const Vec3d low = corner(0, 0), high = corner(1, 1);
                const Vec3d normal = normalized(cross(high - low, corner(0, 1) - corner(1, 0)));
                vectors_.push_back(dot(normal, low) < 0 ? normal * -1.0 : normal);
            }
        }
    }
}

// Each cell into four, which choose among its candidates.
void Codebook::split_cells(const Watch& watch) {
    const uint32_t finer = 2 * resolution_;
    std::vector<uint32_t> begins = {0}, chosen;
    for (uint32_t face = 0; face < 6; ++face) {
        for (uint32_t i = 0; i < finer; ++i) {
            watch.check();
            for (uint32_t j = 0; j < finer; ++j) {
                const auto point = [&](double di, double dj) {
                    return normalized(on_cube(face, -1 + 2 * (i + di) / finer, -1 + 2 * (j + dj) / finer));
                };
                const Vec3d centre = point(0.5, 0.5);
                double least = 1;
                for (const auto& [di, dj] :
                     {std::pair(0, 0), std::pair(0, 1), std::pair(1, 0), std::pair(1, 1)})
                    least = std::min(least, dot(centre, point(di, dj)));
                const uint64_t cell = (uint64_t{face} * resolution_ + i / 2) * resolution_ + j / 2;
                append_near(centre, std::acos(least), candidates(cell), vectors_, chosen);
                begins.push_back(static_cast<uint32_t>(chosen.size()));
            }
        }
    }
    resolution_ = finer;
    begins_ = std::move(begins);
    candidates_ = std::move(chosen);
}

uint32_t Codebook::nearest(Vec3d direction) const {
    const OnCube at = to_cube(direction);
    const auto cell_along = [this](double x) {
        return std::min(static_cast<uint32_t>((x + 1) / 2 * resolution_), resolution_ - 1);
    };
    const uint64_t cell =
        (uint64_t{at.face} * resolution_ + cell_along(at.u)) * resolution_ + cell_along(at.v);
    uint32_t best = 0;
    double most = -std::numeric_limits<double>::infinity();
    for (const uint32_t i : candidates(cell)) {
        const double cosine = dot(direction, vectors_[i]);
        if (cosine > most) most = cosine, best = i;
    }
    return best;
}

}  // namespace coppice
