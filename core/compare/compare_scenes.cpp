#include "core/compare/compare_scenes.h"

#include <algorithm>
#include <limits>

#include "core/base/error.h"
#include "core/base/watched_parallel.h"
#include "core/compare/correspondence.h"
#include "core/compare/deviation.h"

namespace coppice {

namespace {

constexpr uint64_t least_samples = 1000;
constexpr size_t small_mesh = 20'000;  // triangles; such meshes are measured beside each other

// Both directions of two surfaces, and what adds up over several pairs of them.
struct Sums {
    Deviation forward, backward;
    Moments texture_lengths;
    Flips flips;

    void add(const Sums& other, const InstanceWeight& by) {
        add(forward, other.forward, by);
        add(backward, other.backward, by);
        texture_lengths.add_scaled(other.texture_lengths, by);
        flips.triangles += other.flips.triangles;
        flips.texture_triangles += other.flips.texture_triangles;
    }

  private:
    static void add(Deviation& to, const Deviation& from, const InstanceWeight& by) {
        to.distance.add_scaled(from.distance, by);
        to.facets.add(from.facets, by);
        to.normals.add(from.normals, by);
        to.texture.add_unscaled(from.texture, by);
        to.colors.add_unscaled(from.colors, by);
    }
};

Sums measure(Surface reference, Surface candidate, const CompareOptions& options, unsigned threads,
             const Watch& watch) {
    const Bvh of_reference(reference, threads, watch), of_candidate(candidate, threads, watch);
    const SearchedSurface to_reference = {reference, of_reference, reference.bounds.diagonal()};
    const SearchedSurface to_candidate = {candidate, of_candidate, candidate.bounds.diagonal()};
    const auto triangles =
        static_cast<double>(std::max(reference.triangle_count(), candidate.triangle_count()));
    const Sampling sampling = {std::max(least_samples, static_cast<uint64_t>(options.samples * triangles)),
                               options.seed};
    // Which side of a seam is meant has to be decided alike in both directions.
    const double scale_of_reference = texture_scale(reference, watch);
    const double scale = std::max(scale_of_reference, texture_scale(candidate, watch));

    Sums sums;
    sums.forward =
        measure_deviation(reference, to_candidate, scale, sampling, threads, watch.part(0.05, 0.5));
    sums.backward =
        measure_deviation(candidate, to_reference, scale, sampling, threads, watch.part(0.5, 0.95));
    sums.flips = count_flips(to_reference, candidate, threads, watch.part(0.95, 1));
    InstanceWeight in_lengths = {1, scale_of_reference, scale_of_reference * scale_of_reference,
                                 scale_of_reference};
    sums.texture_lengths.add_scaled(sums.forward.texture, in_lengths);
    sums.texture_lengths.add_scaled(sums.backward.texture, in_lengths);
    return sums;
}

Spread spread(const Moments& moments) {
    return {moments.largest, moments.mean(), moments.root_mean_square()};
}

std::optional<Spread> spread_of_both(Moments moments, const Moments& more) {
    moments.add(more);
    if (moments.empty()) return {};
    return spread(moments);
}

std::optional<AngleSpread> spread_of_both(Angles angles, const Angles& more) {
    angles.add(more);
    if (angles.empty()) return {};
    return AngleSpread{angles.largest(), angles.mean(), angles.percentile(0.95)};
}

SurfaceComparison summarize(const Sums& sums) {
    SurfaceComparison out;
    const Spread a = out.reference_to_candidate = spread(sums.forward.distance);
    const Spread b = out.candidate_to_reference = spread(sums.backward.distance);
    out.symmetric = {std::max(a.largest, b.largest), std::max(a.mean, b.mean),
                     std::max(a.root_mean_square, b.root_mean_square)};
    out.facets = spread_of_both(sums.forward.facets, sums.backward.facets);
    out.normals = spread_of_both(sums.forward.normals, sums.backward.normals);
    out.texture = spread_of_both(sums.forward.texture, sums.backward.texture);
    out.colors = spread_of_both(sums.forward.colors, sums.backward.colors);
    if (!sums.texture_lengths.empty()) out.texture_model_units = spread(sums.texture_lengths);
    out.flips = sums.flips;
    return out;
}

std::vector<Instance> drawn(const Scene& scene, std::string_view which) {
    std::vector<Instance> all = instances(scene);
    const bool has_triangles = std::any_of(all.begin(), all.end(), [&](const Instance& instance) {
        return scene.meshes[instance.mesh].triangle_count() > 0;
    });
    require(has_triangles, ErrorCode::asset_no_surface, "",
            "the {} draws no triangle; only surfaces can be compared", which);
    return all;
}

class Comparer {
  public:
    Comparer(const Scene& reference, const Scene& candidate, const CompareOptions& options,
             uint64_t most_triangles, const Watch& watch)
        : reference_(reference),
          candidate_(candidate),
          options_(options),
          most_triangles_(most_triangles),
          watch_(watch) {}

    SceneComparison run() {
        const std::vector<Instance> of_reference = drawn(reference_, "reference");
        const std::vector<Instance> of_candidate = drawn(candidate_, "candidate");
        SceneComparison out;
        out.diagonal = scene_bounds(reference_, of_reference).diagonal();
        const auto same = find_correspondence(reference_, of_reference, candidate_, of_candidate, watch_);
        out.is_by_mesh = same.has_value();
        const Watch measuring = watch_.part(0, 0.9);
        const Sums sums =
            same ? by_mesh(*same, measuring, out.meshes) : expanded(of_reference, of_candidate, measuring);
        out.surface = summarize(sums);
        out.reference = elements_of(reference_, watch_.part(0.9, 0.95));
        out.candidate = elements_of(candidate_, watch_.part(0.95, 1));
        watch_.report(1);
        return out;
    }

  private:
    Sums by_mesh(const Correspondence& same, const Watch& watch, std::vector<MeshComparison>& meshes) {
        std::vector<size_t> large, small;
        std::vector<Sums> sums(reference_.meshes.size());
        for (size_t i = 0; i < sums.size(); ++i) {
            if (same.counts[i] == 0 || reference_.meshes[i].triangle_count() == 0) continue;
            (size_of(i) > small_mesh ? large : small).push_back(i);
        }
        const double share = large.empty() ? 0 : (small.empty() ? 1 : 0.8);
        for (size_t k = 0; k < large.size(); ++k) {
            const auto at = [&](size_t n) {
                return share * static_cast<double>(n) / static_cast<double>(large.size());
            };
            sums[large[k]] = measure_mesh(large[k], options_.threads, watch.part(at(k), at(k + 1)));
        }
        Watch of_one = watch;
        of_one.progress = {};
        watched_parallel_for(small.size(), options_.threads, watch.part(share, 1),
                             [&](size_t k) { sums[small[k]] = measure_mesh(small[k], 1, of_one); });

        Sums all;
        for (size_t i = 0; i < sums.size(); ++i) {
            if (sums[i].forward.distance.empty()) continue;
            all.add(sums[i], same.weights[i]);
            meshes.push_back({reference_.meshes[i].name, same.counts[i], same.weights[i].largest_scale,
                              summarize(sums[i])});
        }
        return all;
    }

    size_t size_of(size_t mesh) const {
        return std::max(reference_.meshes[mesh].triangle_count(), candidate_.meshes[mesh].triangle_count());
    }

    Sums measure_mesh(size_t mesh, unsigned threads, const Watch& watch) const {
        return measure(make_surface(reference_.meshes[mesh], watch),
                       make_surface(candidate_.meshes[mesh], watch), options_, threads, watch);
    }

    Sums expanded(const std::vector<Instance>& of_reference, const std::vector<Instance>& of_candidate,
                  const Watch& watch) const {
        require_room(reference_, of_reference, "reference");
        require_room(candidate_, of_candidate, "candidate");
        return measure(make_surface(reference_, of_reference, watch),
                       make_surface(candidate_, of_candidate, watch), options_, options_.threads, watch);
    }

    void require_room(const Scene& scene, const std::vector<Instance>& instances,
                      std::string_view which) const {
        uint64_t triangles = 0, wedges = 0;
        for (const Instance& instance : instances) {
            triangles += scene.meshes[instance.mesh].triangle_count();
            wedges += scene.meshes[instance.mesh].wedge_count();
        }
        require(triangles <= most_triangles_, ErrorCode::asset_too_large, "",
                "the scenes do not place the same meshes, so that all instances are compared: the {} has {} "
                "triangles with every instance, and the limit is {} (triangles)",
                which, triangles, most_triangles_);
        require(wedges < std::numeric_limits<uint32_t>::max(), ErrorCode::asset_too_large, "",
                "the {} has {} vertices with every instance, which is more than can be compared", which,
                wedges);
    }

    SceneElements elements_of(const Scene& scene, const Watch& watch) const {
        SceneElements out;
        if (options_.self_intersections) out.self_intersections = SelfIntersections{};
        const auto count = static_cast<double>(scene.meshes.size());
        for (size_t i = 0; i < scene.meshes.size(); ++i) {
            watch.report(static_cast<double>(i) / count);
            const Mesh& mesh = scene.meshes[i];
            out.elements.add(count_elements(mesh, watch));
            if (!options_.self_intersections || mesh.triangle_count() == 0) continue;
            Surface surface = make_surface(mesh, watch);
            const Bvh bvh(surface, options_.threads, watch);
            Watch quiet = watch;
            quiet.progress = {};
            const SelfIntersections found = find_self_intersections(surface, bvh, options_.threads, quiet);
            out.self_intersections->pairs += found.pairs;
            out.self_intersections->triangles += found.triangles;
        }
        return out;
    }

    const Scene& reference_;
    const Scene& candidate_;
    const CompareOptions& options_;
    uint64_t most_triangles_;
    const Watch& watch_;
};

}  // namespace

SceneComparison compare_scenes(const Scene& reference, const Scene& candidate, const CompareOptions& options,
                               uint64_t most_triangles, const Watch& watch) {
    return Comparer(reference, candidate, options, most_triangles, watch).run();
}

SurfaceComparison compare_meshes(const Mesh& reference, const Mesh& candidate, const CompareOptions& options,
                                 const Watch& watch) {
    return summarize(measure(make_surface(reference, watch), make_surface(candidate, watch), options,
                             options.threads, watch));
}

}  // namespace coppice
