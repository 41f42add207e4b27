#include "core/simplify/ias.h"

#include <array>
#include <memory>
#include <numeric>

#include "core/simplify/cheapest_first.h"
#include "core/simplify/edge_collapse.h"
#include "core/simplify/instance_pruning.h"
#include "core/simplify/instance_weights.h"
#include "core/simplify/plane_error.h"
#include "core/simplify/target.h"

namespace coppice {

namespace {

// One mesh of the scene at work.
class Member {
  public:
    Member(const Mesh& mesh, std::span<const Transform> instances, const Target& target, const Watch& watch)
        : weights_(instances),
          work_(
              mesh, target, {.freedom = Freedom::segment},
              [&](const CollapseParts& parts) { return make_error(parts, watch); }, watch),
          order_(work_, watch) {
        order_.queue_all();
    }
    Member(const Member&) = delete;
    Member& operator=(const Member&) = delete;

    EdgeCollapse& work() { return work_; }
    CheapestFirst<EdgeCollapse>& order() { return order_; }

  private:
    std::unique_ptr<CollapseError> make_error(const CollapseParts& parts, const Watch& watch) const {
        const PlaneOptions options = {.instance_weight = [this](Vec3d n) { return weights_(n); }};
        return std::make_unique<PlaneError>(parts, options, watch);
    }

    InstanceWeights weights_;
    EdgeCollapse work_;
    CheapestFirst<EdgeCollapse> order_;
};

std::span<const Parameter> parameters() {
    static const std::array<Parameter, 2> list = {{
        {.id = "prune_instances",
         .title =
             "where collapses end short of ratio, drops instances of meshes that stand 1000 times or more "
             "and enlarges the others",
         .kind = Parameter::Kind::boolean,
         .default_value = false},
        {.id = "seed",
         .title = "prune_instances=true: what chance starts with; the same drops the same",
         .kind = Parameter::Kind::integer,
         .default_value = 1.0,
         .minimum = 0,
         .maximum = 0x1p53},
    }};
    return list;
}

class SceneSimplification {
  public:
    SceneSimplification(std::span<const Mesh> meshes, std::span<const std::vector<Transform>> instances,
                        const SceneTarget& target, const Watch& watch)
        : meshes_(meshes), instances_(instances), target_(target), watch_(watch), heap_(meshes.size()) {
        members_.reserve(meshes.size());
        for (uint32_t m = 0; m < meshes.size(); ++m) {
            watch.check();
            load_ += load_of(m) * meshes[m].triangle_count();
            const bool takes_part = load_of(m) > 0 && meshes[m].triangle_count() > 0;
            members_.push_back(
                takes_part ? std::make_unique<Member>(meshes[m], instances[m], target.of_mesh[m], watch)
                           : nullptr);
        }
        first_load_ = load_;
    }

    std::vector<Simplified> run() {
        const bool is_small_enough = done();
        if (!is_small_enough) collapse();
        std::vector<Simplified> results;
        for (uint32_t m = 0; m < meshes_.size(); ++m) {
            if (!members_[m]) {
                results.push_back({.mesh = meshes_[m], .stop_reason = StopReason::already_smaller});
                continue;
            }
            if (is_small_enough) {
                results.push_back(already_smaller(meshes_[m], watch_));
                continue;
            }
            EdgeCollapse& work = members_[m]->work();
            results.push_back(work.finish(done() ? StopReason::target : work.reason_for_refusals(), watch_));
        }
        return results;
    }

    bool done() const { return target_.triangles && load_ <= *target_.triangles; }

  private:
    // What a triangle of the mesh counts.
    uint64_t load_of(uint32_t mesh) const {
        return target_.rendered ? instances_[mesh].size() : uint64_t{!instances_[mesh].empty()};
    }

    // Rounds, while they pay: see CheapestFirst::run.
    void collapse() {
        uint64_t collapses = 0, left = 0;
        do {
            collapses = left = 0;
            for (uint32_t m = 0; m < members_.size(); ++m) {
                if (!members_[m]) continue;
                if (rounds_ > 0) members_[m]->order().queue_all();
                queue(m);
                left += members_[m]->work().mesh().live_vertices();
            }
            for (uint64_t step = 0; !heap_.empty() && !done(); ++step) {
                if (step % 16 == 0) watch_.check();
                if (step % 512 == 0) report();
                collapses += collapse_one(heap_.top());
            }
            ++rounds_;
        } while (!done() && collapses > left / 1000);
    }

    bool collapse_one(uint32_t mesh) {
        Member& member = *members_[mesh];
        const uint32_t before = member.work().mesh().live_triangles();
        const bool collapsed = member.order().try_cheapest();
        load_ -= load_of(mesh) * (before - member.work().mesh().live_triangles());
        queue(mesh);
        return collapsed;
    }

    void queue(uint32_t mesh) {
        const CheapestFirst<EdgeCollapse>& order = members_[mesh]->order();
        if (order.empty()) {
            heap_.erase(mesh);
        } else {
            heap_.set(mesh, order.cheapest());
        }
    }

    void report() const {
        const uint64_t to = target_.triangles.value_or(0);
        watch_.report(first_load_ > to
                          ? static_cast<double>(first_load_ - load_) / static_cast<double>(first_load_ - to)
                          : 1.0);
    }

    std::span<const Mesh> meshes_;
    std::span<const std::vector<Transform>> instances_;
    const SceneTarget& target_;
    const Watch& watch_;
    std::vector<std::unique_ptr<Member>> members_;  // per mesh; none where nothing is drawn
    IndexedHeap heap_;                              // meshes, by their cheapest edge
    uint64_t load_ = 0, first_load_ = 0;            // triangles as the target counts them
    int rounds_ = 0;
};

// What is left to do once nothing collapses any more. A target in stored triangles would not be met so.
void prune(SimplifiedScene& scene, std::span<const std::vector<Transform>> instances, uint64_t triangles,
           const ParameterValues& values, const Watch& watch) {
    const PruneTarget target = {.rendered_triangles = triangles,
                                .seed = static_cast<uint64_t>(*values.number("seed"))};
    scene.dropped_instances = prune_instances(scene.meshes, instances, target, watch);
    uint64_t drawn = 0;
    for (size_t m = 0; m < scene.meshes.size(); ++m) {
        const size_t left = instances[m].size() - scene.dropped_instances[m].size();
        drawn += left * scene.meshes[m].mesh.triangle_count();
    }
    if (drawn > triangles) return;
    for (Simplified& mesh : scene.meshes) {
        if (mesh.stop_reason != StopReason::already_smaller) mesh.stop_reason = StopReason::target;
    }
}

SimplifiedScene simplify_scene(std::span<const Mesh> meshes,
                               std::span<const std::vector<Transform>> instances, const SceneTarget& target,
                               const ParameterValues& values, const Watch& watch) {
    watch.check();
    SceneSimplification work(meshes, instances, target, watch);
    SimplifiedScene scene = {.meshes = work.run()};
    const bool is_short = target.triangles && target.rendered && !work.done();
    if (values.boolean("prune_instances") && is_short)
        prune(scene, instances, *target.triangles, values, watch);
    watch.report(1.0);
    return scene;
}

}  // namespace

Algorithm ias() {
    return {.id = "ias",
            .title = "Instance-aware simplification",
            .citation =
                "T. Azim, E. Cheslack-Postava, P. Levis: Instance-aware simplification of 3D polygonal "
                "meshes. IEEE ICME 2015",
            .parameters = parameters(),
            .instance_aware = true,
            .bytes_per_triangle = 320,
            .simplify_scene = simplify_scene};
}

}  // namespace coppice
