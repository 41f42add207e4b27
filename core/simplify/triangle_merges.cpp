#include "core/simplify/triangle_merges.h"

#include <algorithm>
#include <numeric>
#include <vector>

#include "core/base/watched_loop.h"
#include "core/simplify/guarded_clusters.h"
#include "core/simplify/plain_clusters.h"
#include "core/simplify/target.h"

namespace coppice {

namespace {

constexpr uint32_t all_corners = 7;

class TriangleRule final : public ClusterRule {
  public:
    explicit TriangleRule(const TriangleMerges& merges) : merges_(merges) {}

    void begin_round(const CollapseMesh& mesh, const Watch& watch) override {
        triangles_.clear();
        triangles_.reserve(mesh.live_triangles());
        vertex_count_ = mesh.vertex_count();
        longest_ = 0;
        double sum = 0;
        watched_loop(mesh.triangle_count(), watch, [&](size_t i) {
            const auto t = static_cast<uint32_t>(i);
            if (!mesh.is_live_triangle(t)) return;
            Triangle x;
            std::array<double, 3> edges{};
            for (uint32_t k = 0; k < 3; ++k) x.corners[k] = mesh.corner_vertex(3 * t + k);
            for (size_t k = 0; k < 3; ++k)
                edges[k] = length(mesh.position(x.corners[(k + 1) % 3]) - mesh.position(x.corners[k]));
            // The ends of the shortest edge first.
            const auto turn = std::min_element(edges.begin(), edges.end()) - edges.begin();
            std::rotate(edges.begin(), edges.begin() + turn, edges.end());
            std::rotate(x.corners.begin(), x.corners.begin() + turn, x.corners.end());
            for (size_t k = 0; k < 3; ++k) x.edges[k] = static_cast<float>(edges[k]);
            x.longest = *std::max_element(x.edges.begin(), x.edges.end());
            sum += double{x.longest};
            longest_ = std::max(longest_, double{x.longest});
            triangles_.push_back(x);
        });
        mean_longest_ = triangles_.empty() ? 0 : sum / static_cast<double>(triangles_.size());
        sort_by_length(watch);
    }

    double usual_threshold() const override { return 1.5 * mean_longest_; }
    double largest_threshold() const override { return 1.000001 * longest_; }

    void offer(double threshold, const Take& take) override {
        taken_.assign(vertex_count_, 0);
        for (const Triangle& t : triangles_) {
            if (double{t.edges[0]} > threshold || taken_[t.corners[0]] + taken_[t.corners[1]] != 0) continue;
            const uint32_t bits =
                merges_.decide({double{t.edges[0]}, double{t.edges[1]}, double{t.edges[2]}}, threshold);
            if (bits == 0 || (bits == all_corners && taken_[t.corners[2]] != 0)) continue;
            const size_t merged = take(std::span(t.corners).first(bits == all_corners ? 3 : 2));
            for (size_t k = 0; k < merged; ++k) taken_[t.corners[k]] = 1;
        }
    }

    Placement place(const CollapseMesh& mesh, std::span<const uint32_t> set) override {
        const Vec3d a = mesh.position(set[0]), b = mesh.position(set[1]);
        place_.weights = {0.5, 0.5, 0};
        place_.point = (a + b) * 0.5;
        if (set.size() == 3) place_ = circumcentre(a, b, mesh.position(set[2]), merges_.circumcentre);
        return {place_.point, std::span(place_.weights).first(set.size())};
    }

  private:
    struct Triangle {
        std::array<float, 3> edges = {};
        std::array<uint32_t, 3> corners = {};
        float longest = 0;
    };

    // Only about, by an eighth of the mean: in the order of the mesh among about equals, where neighbours are
    // near each other in memory.
    void sort_by_length(const Watch& watch) {
        constexpr size_t buckets = 32;
        const auto bucket = [this](const Triangle& t) {
            return mean_longest_ > 0 ? static_cast<size_t>(std::min(8 * double{t.longest} / mean_longest_,
                                                                    double{buckets - 1}))
                                     : 0;
        };
        std::array<size_t, buckets + 1> begin{};
        watched_loop(triangles_.size(), watch, [&](size_t i) { ++begin[bucket(triangles_[i]) + 1]; });
        std::partial_sum(begin.begin(), begin.end(), begin.begin());
        std::vector<Triangle> sorted = watched_vector<Triangle>(triangles_.size(), watch);
        watched_loop(triangles_.size(), watch,
                     [&](size_t i) { sorted[begin[bucket(triangles_[i])]++] = triangles_[i]; });
        triangles_ = std::move(sorted);
    }

    TriangleMerges merges_;
    std::vector<Triangle> triangles_;
    std::vector<uint8_t> taken_;  // per vertex
    uint32_t vertex_count_ = 0;
    double mean_longest_ = 0, longest_ = 0;
    WeighedPoint place_;
};

// One pass as printed.
uint64_t merge_as_printed(const Mesh& source, const TriangleMerges& merges, VertexClusters& clusters,
                          double threshold, uint64_t most, const Watch& watch) {
    uint64_t done = 0;
    std::array<uint32_t, 3> set{};
    for (size_t t = 0; t < source.triangle_count() && done < most; ++t) {
        if (t % watched_stride == 0) watch.check();
        const std::array<uint32_t, 3> v = {clusters.root(source.corner_vertex(t, 0)),
                                           clusters.root(source.corner_vertex(t, 1)),
                                           clusters.root(source.corner_vertex(t, 2))};
        if (v[0] == v[1] || v[1] == v[2] || v[2] == v[0]) continue;
        const Vec3d p[] = {clusters.position(v[0]), clusters.position(v[1]), clusters.position(v[2])};
        const std::array<double, 3> edges = {length(p[1] - p[0]), length(p[2] - p[1]), length(p[0] - p[2])};
        const uint32_t bits = merges.decide(edges, threshold);
        if (bits == 0) continue;
        size_t count = 0;
        for (size_t k = 0; k < 3; ++k)
            if ((bits >> k & 1U) != 0) set[count++] = v[k];
        const std::span<const uint32_t> roots = std::span(set).first(count);
        const bool free =
            std::none_of(roots.begin(), roots.end(), [&](uint32_t r) { return clusters.is_merged(r); });
        if (!merges.sequential && !free) continue;
        const Vec3d point = bits == all_corners
                                ? circumcentre(p[0], p[1], p[2], merges.circumcentre).point
                                : (clusters.position(set[0]) + clusters.position(set[1])) * 0.5;
        clusters.merge(roots, point);
        ++done;
    }
    return done;
}

}  // namespace

Simplified simplify_by_triangles(const Mesh& source, const Target& target, const TriangleMerges& merges,
                                 const RoundOptions& options, const Watch& watch) {
    watch.check();
    if (is_small_enough(source, target)) return already_smaller(source, watch);
    if (merges.as_printed) {
        const PlainPass pass = [&](VertexClusters& clusters, double threshold, uint64_t most) {
            return merge_as_printed(source, merges, clusters, threshold, most, watch);
        };
        return simplify_by_plain_clusters(source, target, pass, options, watch);
    }
    TriangleRule rule(merges);
    return simplify_by_guarded_clusters(source, target, rule, options, watch);
}

}  // namespace coppice
