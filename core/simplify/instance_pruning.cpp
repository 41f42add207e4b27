#include "core/simplify/instance_pruning.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/base/random.h"
#include "core/base/watched_loop.h"

namespace coppice {

namespace {

constexpr size_t fewest_instances = 1000;
constexpr size_t fewest_of_all = 20;  // one in so many: 5 %

bool deforms(const Mesh& mesh) {
    return !mesh.morph_targets.empty() || mesh.find_attribute("JOINTS_0") != nullptr;
}

// Whether all positions are numbers still once they are so many times as far from the origin.
bool may_grow(const Mesh& mesh, double times) {
    constexpr double most = std::numeric_limits<float>::max();
    return std::all_of(mesh.positions.begin(), mesh.positions.end(), [&](const Vec3f& p) {
        return times * std::max({std::abs(p.x), std::abs(p.y), std::abs(p.z)}) <= most;
    });
}

bool contains(const Bounds& outer, const Bounds& inner) {
    const double slack = 1e-9 * outer.diagonal();
    const Vec3d low = inner.min - outer.min, high = outer.max - inner.max;
    return std::min({low.x, low.y, low.z, high.x, high.y, high.z}) >= -slack;
}

Transform enlarged(const Transform& instance, double scale) {
    return instance * from_trs({}, {0, 0, 0, 1}, {scale, scale, scale});
}

// What moves farthest is what is farthest from the origin.
void enlarge(Simplified& simplified, double scale) {
    Mesh& mesh = simplified.mesh;
    double farthest = 0;
    for (Vec3f& position : mesh.positions) {
        const Vec3d p = to_double(position);
        farthest = std::max(farthest, length(p));
        position = to_float(p * scale);
    }
    mesh.position_storage = {};
    simplified.error_model_units = simplified.error_model_units * scale + farthest * (scale - 1);
}

class Pruning {
  public:
    Pruning(std::span<Simplified> meshes, std::span<const std::vector<Transform>> instances,
            const PruneTarget& target, const Watch& watch)
        : meshes_(meshes), instances_(instances), random_(target.seed), watch_(watch) {
        size_t all = 0;
        for (const std::vector<Transform>& of_mesh : instances) all += of_mesh.size();
        uint64_t drawn = 0, of_frequent = 0;
        for (uint32_t m = 0; m < meshes.size(); ++m) {
            const size_t count = instances[m].size();
            const uint64_t load = count * meshes[m].mesh.triangle_count();
            drawn += load;
            if (load == 0 || count < fewest_instances || count * fewest_of_all < all) continue;
            if (deforms(meshes[m].mesh) || !may_grow(meshes[m].mesh, std::sqrt(count))) continue;
            frequent_.push_back(m);
            of_frequent += load;
        }
        const uint64_t over = drawn - std::min(drawn, target.rendered_triangles);
        left_ = of_frequent - std::min(over, of_frequent);
        of_frequent_ = of_frequent;
    }

    std::vector<std::vector<uint32_t>> run() {
        std::vector<std::vector<uint32_t>> dropped(meshes_.size());
        if (left_ == of_frequent_) return dropped;
        find_box();
        for (const uint32_t m : frequent_) {
            const size_t count = instances_[m].size(), kept = kept_of(count);
            const double scale = std::sqrt(static_cast<double>(count) / static_cast<double>(kept));
            dropped[m] = draw(m, count - kept, scale);
            enlarge(meshes_[m], scale);
        }
        return dropped;
    }

  private:
    // Rounded down, so that the target is met.
    size_t kept_of(size_t count) const {
        const double share =
            static_cast<double>(count) * static_cast<double>(left_) / static_cast<double>(of_frequent_);
        return std::max<size_t>(1, static_cast<size_t>(share));
    }

    void find_box() {
        for (uint32_t m = 0; m < meshes_.size(); ++m) {
            const Bounds box = bounds(meshes_[m].mesh.positions);
            if (box.empty()) continue;
            watched_loop(instances_[m].size(), watch_,
                         [&](size_t i) { box_.extend(transform_bounds(instances_[m][i], box)); });
        }
    }

    // Of those that would leave the box first, then of the rest.
    std::vector<uint32_t> draw(uint32_t mesh, size_t count, double scale) {
        const Bounds box = bounds(meshes_[mesh].mesh.positions);
        std::vector<uint32_t> leaving, staying;
        watched_loop(instances_[mesh].size(), watch_, [&](size_t i) {
            const bool stays = contains(box_, transform_bounds(enlarged(instances_[mesh][i], scale), box));
            (stays ? staying : leaving).push_back(static_cast<uint32_t>(i));
        });
        std::vector<uint32_t> drawn;
        for (std::vector<uint32_t>* pool : {&leaving, &staying}) {
            while (drawn.size() < count && !pool->empty()) {
                std::swap((*pool)[random_.below(static_cast<uint32_t>(pool->size()))], pool->back());
                drawn.push_back(pool->back());
                pool->pop_back();
            }
        }
        std::sort(drawn.begin(), drawn.end());
        return drawn;
    }

    std::span<Simplified> meshes_;
    std::span<const std::vector<Transform>> instances_;
    Random random_;
    const Watch& watch_;
    std::vector<uint32_t> frequent_;       // meshes that may lose instances
    uint64_t of_frequent_ = 0, left_ = 0;  // their drawn triangles, before and after
    Bounds box_;                           // of the scene, of the boxes of its instances
};

}  // namespace

std::vector<std::vector<uint32_t>> prune_instances(std::span<Simplified> meshes,
                                                   std::span<const std::vector<Transform>> instances,
                                                   const PruneTarget& target, const Watch& watch) {
    return Pruning(meshes, instances, target, watch).run();
}

}  // namespace coppice
