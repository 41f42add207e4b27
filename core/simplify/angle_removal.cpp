#include "core/simplify/angle_removal.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>
#include <vector>

#include "core/base/watched_loop.h"
#include "core/simplify/cluster_rounds.h"
#include "core/simplify/target.h"

namespace coppice {

namespace {

constexpr float never = -2, flat = 1 + 1e-6F;  // rounding makes normals a bit longer than 1

// Thresholds are angles between normals, in degrees: 180 less the included angle.
class AngleStage final : public ClusterStage {
  public:
    AngleStage(VertexRemoval& work, const Target& target, const AngleOptions& options)
        : work_(work),
          target_(target),
          options_(options),
          flatness_(work.mesh().vertex_count(), never),
          changed_(work.mesh().vertex_count(), 1),
          locked_(work.mesh().vertex_count(), 0) {}

    double live_triangles() const override { return work_.mesh().live_triangles(); }
    bool done() const override { return work_.done(); }
    double fraction() const override { return work_.fraction(); }

    double target_triangles() const override { return triangles_when_met(target_, work_.mesh()); }

    void begin_round(const Watch& watch) override {
        watch_ = &watch;
        work_.forget_refusals();
        if (options_.area_limit) measure_areas(watch);
        watched_loop(flatness_.size(), watch, [this](size_t v) {
            if (changed_[v] == 0 && !options_.area_limit) return;
            const auto vertex = static_cast<uint32_t>(v);
            const bool may_go = work_.mesh().is_live_vertex(vertex) && work_.kind_allows(vertex);
            flatness_[v] = may_go ? flatness(vertex) : never;
            changed_[v] = 0;
        });
    }
    double usual_threshold() const override { return 180 - default_angle; }
    double largest_threshold() const override { return 180; }

    double count(double threshold, const Watch& watch) override {
        watch_ = &watch;
        double left = live_triangles();
        for_each_flat(threshold, [&](uint32_t vertex) {
            left -= work_.triangles_saved(vertex);
            lock_around(vertex);
        });
        return left;
    }

    void run(double threshold, const Watch& watch) override {
        watch_ = &watch;
        uint64_t step = 0;
        for_each_flat(threshold, [&](uint32_t vertex) {
            if (work_.done()) return;
            if (++step % 64 == 0) watch.check();
            if (step % 1024 == 0) watch.report(work_.fraction());
            if (work_.try_remove(vertex) != Refusal::none) return;
            changed_[vertex] = 1;
            for (const uint32_t v : work_.around()) locked_[v] = changed_[v] = 1;
        });
    }

    StopReason reason_for_refusals() const override { return work_.reason_for_refusals(); }

  private:
    template <typename Use>
    void for_each_flat(double threshold, Use&& use) {
        std::fill(locked_.begin(), locked_.end(), uint8_t{0});
        const auto least = static_cast<float>(std::cos(threshold * std::numbers::pi / 180));
        watched_loop(flatness_.size(), *watch_, [&](size_t v) {
            if (flatness_[v] > least && locked_[v] == 0) use(static_cast<uint32_t>(v));
        });
    }

    void lock_around(uint32_t vertex) {
        const CollapseMesh& mesh = work_.mesh();
        for (uint32_t c = mesh.first_corner(vertex); c != no_index; c = mesh.corner_after(c)) {
            locked_[mesh.corner_vertex(CollapseMesh::next_corner(c))] = 1;
            locked_[mesh.corner_vertex(CollapseMesh::previous_corner(c))] = 1;
        }
    }

    void measure_areas(const Watch& watch) {
        const CollapseMesh& mesh = work_.mesh();
        areas_.assign(mesh.vertex_count(), 0);
        double sum = 0;
        for_each_triangle(mesh, watch, [&](uint32_t, const std::array<uint32_t, 3>& v) {
            const double area =
                length(area_normal(mesh.position(v[0]), mesh.position(v[1]), mesh.position(v[2]))) / 2;
            for (const uint32_t vertex : v) areas_[vertex] += area;
            sum += 3 * area;
        });
        if (largest_area_ == 0)
            largest_area_ = *options_.area_limit * sum / std::max(1U, mesh.live_vertices());
    }

    // The least cosine between normals around a vertex, or where the options say how many angles count, the
    // last of so many; `never` where it stays.
    float flatness(uint32_t vertex) {
        if (options_.area_limit && !(areas_[vertex] < largest_area_)) return never;
        gather_fan(vertex);
        float least = options_.count ? cosine_of_last() : least_cosine();
        if (options_.stitch == Stitch::paper) return least;
        if (!options_.count && least < crease_cosine) least = std::min(least, cosine_where_creases_meet());
        if (work_.kind(vertex) == VertexKind::manifold) return least;
        return std::min(least, static_cast<float>(work_.line_turn_cosine(vertex)));
    }

    float least_cosine() const {
        float least = flat;
        for_each_pair(options_.all_pairs, [&](float cosine) { least = std::min(least, cosine); });
        return least;
    }

    float cosine_of_last() {
        cosines_.clear();
        for_each_pair(options_.all_pairs, [&](float cosine) { cosines_.push_back(cosine); });
        const size_t last = std::min<uint64_t>(*options_.count, cosines_.size());
        if (last == 0) return flat;
        const auto at = cosines_.begin() + static_cast<std::ptrdiff_t>(last - 1);
        std::nth_element(cosines_.begin(), at, cosines_.end(), std::greater<>());
        return *at;
    }

    // At the corner of a box no angle is smaller than along its edges, but it has to stay longer.
    float cosine_where_creases_meet() {
        uint32_t creases = 0;
        double sum = 0;
        for_each_pair(false, [&](float cosine) {
            if (cosine >= crease_cosine) return;
            ++creases;
            sum += std::acos(std::max(-1.0, double{cosine}));
        });
        return creases < 3 ? flat : static_cast<float>(std::cos(std::min(sum, 0.99 * std::numbers::pi)));
    }

    // Calls use with the cosine between the normals of two triangles: that share an edge, or any.
    template <typename Use>
    void for_each_pair(bool all, Use&& use) const {
        const AtVertex* const fan = fan_.data();
        for (uint32_t i = 0; i < fan_size_; ++i) {
            for (uint32_t j = all ? i + 1 : 0; j < fan_size_; ++j) {
                if (!all && fan[j].begins != fan[i].ends) continue;
                use(dot(fan[i].normal, fan[j].normal));
                if (!all) break;
            }
        }
    }

    struct AtVertex {
        Vec3f normal;           // of a triangle
        uint32_t begins, ends;  // its other two vertices
    };

    void gather_fan(uint32_t vertex) {
        const CollapseMesh& mesh = work_.mesh();
        AtVertex* last = fan_.data();
        for (uint32_t c = mesh.first_corner(vertex); c != no_index; c = mesh.corner_after(c), ++last)
            *last = {work_.normal(c / 3), mesh.corner_vertex(CollapseMesh::next_corner(c)),
                     mesh.corner_vertex(CollapseMesh::previous_corner(c))};
        fan_size_ = static_cast<uint32_t>(last - fan_.data());
    }

    VertexRemoval& work_;
    const Target& target_;
    const AngleOptions& options_;
    const Watch* watch_ = nullptr;  // of the round
    std::vector<float> flatness_;   // per vertex
    std::vector<uint8_t> changed_;  // per vertex: since flatness was measured
    std::vector<uint8_t> locked_;   // per vertex
    std::vector<double> areas_;     // of the triangles around each vertex, where there is a limit
    double largest_area_ = 0;
    std::array<AtVertex, largest_removable_valence> fan_ = {};
    uint32_t fan_size_ = 0;
    std::vector<float> cosines_;
};

}  // namespace

Simplified remove_by_angle(const Mesh& source, const Target& target, const AngleOptions& options,
                           const Watch& watch) {
    watch.check();
    if (is_small_enough(source, target)) return already_smaller(source, watch);
    VertexRemoval work(source, target, options.stitch, options.lines, watch);
    AngleStage stage(work, target, options);
    RoundOptions rounds = {.rounds = options.rounds, .patient = true};
    if (options.angle || !is_set(target)) rounds.threshold = 180 - options.angle.value_or(default_angle);
    const RoundsDone done = run_rounds(stage, target, rounds, watch);
    Simplified result = work.finish(done.reason, watch);
    watch.report(1.0);
    result.threshold_used = 180 - done.threshold;
    return result;
}

}  // namespace coppice
