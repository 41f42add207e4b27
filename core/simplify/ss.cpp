#include "core/simplify/ss.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/base/watched_loop.h"
#include "core/simplify/cluster_parameters.h"
#include "core/simplify/plain_clusters.h"
#include "core/simplify/sphere_rule.h"
#include "core/simplify/target.h"

namespace coppice {

namespace {

// Cells of an edge of the radius, so that a ball reaches into the 27 around its centre. Sorted by cell; a
// hash of the cell names it, and two cells of one hash cost time only.
class Grid {
  public:
    Grid(const std::vector<Vec3d>& points, double cell) : cell_(cell) {
        for (uint32_t i = 0; i < points.size(); ++i) entries_.emplace_back(key(at(points[i])), i);
        std::sort(entries_.begin(), entries_.end());
    }

    template <typename Use>
    void for_each_near(Vec3d p, Use&& use) const {
        const Cell centre = at(p);
        std::array<uint64_t, 27> keys{};
        size_t count = 0;
        for (int64_t x = -1; x <= 1; ++x)
            for (int64_t y = -1; y <= 1; ++y)
                for (int64_t z = -1; z <= 1; ++z)
                    keys[count++] = key({centre[0] + x, centre[1] + y, centre[2] + z});
        std::sort(keys.begin(), keys.end());
        for (size_t k = 0; k < count; ++k) {
            if (k > 0 && keys[k] == keys[k - 1]) continue;
            auto e = std::lower_bound(entries_.begin(), entries_.end(), std::pair(keys[k], 0U));
            for (; e != entries_.end() && e->first == keys[k]; ++e) use(e->second);
        }
    }

  private:
    using Cell = std::array<int64_t, 3>;

    Cell at(Vec3d p) const {
        return {static_cast<int64_t>(std::floor(p.x / cell_)), static_cast<int64_t>(std::floor(p.y / cell_)),
                static_cast<int64_t>(std::floor(p.z / cell_))};
    }
    static uint64_t key(const Cell& c) {
        return (static_cast<uint64_t>(c[0]) * 73856093U) ^ (static_cast<uint64_t>(c[1]) * 19349663U) ^
               (static_cast<uint64_t>(c[2]) * 83492791U);
    }

    double cell_;
    std::vector<std::pair<uint64_t, uint32_t>> entries_;
};

// Whatever is in the ball, in the order of the vertices: as printed.
uint64_t scan_as_printed(const Mesh& source, VertexClusters& clusters, double radius, uint64_t most,
                         const Watch& watch) {
    std::vector<uint32_t> roots;
    std::vector<Vec3d> points;
    for (uint32_t v = 0; v < source.vertex_count(); ++v) {
        if (clusters.root(v) != v) continue;
        roots.push_back(v);
        points.push_back(clusters.position(v));
    }
    const double cell = std::max(radius, 1e-5 * mean_edge(source));
    const Grid grid(points, cell > 0 ? cell : 1);
    std::vector<bool> taken(roots.size());
    std::vector<uint32_t> ball;
    uint64_t done = 0;
    for (uint32_t seed = 0; seed < roots.size() && done < most; ++seed) {
        if (seed % 1024 == 0) watch.check();
        if (taken[seed]) continue;
        ball.clear();
        Vec3d sum;
        grid.for_each_near(points[seed], [&](uint32_t i) {
            if (taken[i] || squared_length(points[i] - points[seed]) > radius * radius) return;
            taken[i] = true;
            ball.push_back(roots[i]);
            sum = sum + points[i];
        });
        if (ball.size() < 2) continue;
        clusters.merge(ball, sum * (1.0 / static_cast<double>(ball.size())));
        ++done;
    }
    return done;
}

std::span<const Parameter> parameters() {
    static const std::array<Parameter, 3> list = {{
        length_parameter("radius",
                         "vertices in a ball of this radius are merged; found by search unless given"),
        neighborhood_parameter,
        passes_parameter,
    }};
    return list;
}

Simplified simplify(const Mesh& source, std::span<const Transform>, const Target& target,
                    const ParameterValues& values, const Watch& watch) {
    return scan_spheres(
        source, target, neighborhood_in(values),
        {.threshold = threshold_in(source, values.length("radius")), .rounds = rounds_in(values)}, watch);
}

}  // namespace

Neighborhood neighborhood_in(const ParameterValues& values) {
    return values.text("neighborhood") == "euclidean" ? Neighborhood::euclidean : Neighborhood::connected;
}

Simplified scan_spheres(const Mesh& source, const Target& target, Neighborhood neighborhood,
                        const RoundOptions& radius_and_rounds, const Watch& watch) {
    watch.check();
    if (is_small_enough(source, target)) return already_smaller(source, watch);
    if (neighborhood == Neighborhood::connected) {
        SphereRule rule;
        return simplify_by_guarded_clusters(source, target, rule, radius_and_rounds, watch);
    }
    const PlainPass pass = [&](VertexClusters& clusters, double radius, uint64_t most) {
        return scan_as_printed(source, clusters, radius, most, watch);
    };
    return simplify_by_plain_clusters(source, target, pass, radius_and_rounds, watch);
}

Algorithm ss() {
    return {.id = "ss",
            .title = "Spherical scanning: vertices within a ball merge",
            .citation = li_kim_2020,
            .parameters = parameters(),
            .bytes_per_triangle = 260,
            .simplify = simplify};
}

}  // namespace coppice
