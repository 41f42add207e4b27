#include "core/scene/instance.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>

#include "core/base/error.h"
#include "core/base/watched_loop.h"

namespace coppice {

namespace {

// Calls visit(node) for every node under the roots, parents first, in depth-first order. No recursion: a
// hostile file may be deep.
template <typename Visit>
void walk(const Scene& scene, const std::vector<uint32_t>& roots, Visit visit) {
    std::vector<uint32_t> stack(roots.rbegin(), roots.rend());
    while (!stack.empty()) {
        const uint32_t node = stack.back();
        stack.pop_back();
        visit(node);
        const auto& children = scene.nodes[node].children;
        stack.insert(stack.end(), children.rbegin(), children.rend());
    }
}

std::vector<uint32_t> all_roots(const Scene& scene) {
    std::vector<uint32_t> roots;
    for (uint32_t n = 0; n < scene.nodes.size(); ++n) {
        if (!scene.nodes[n].parent) roots.push_back(n);
    }
    return roots;
}

}  // namespace

std::vector<Transform> world_transforms(const Scene& scene) {
    std::vector<Transform> world(scene.nodes.size());
    walk(scene, all_roots(scene), [&](uint32_t n) {
        const Node& node = scene.nodes[n];
        world[n] = node.parent ? world[*node.parent] * node.local : node.local;
    });
    return world;
}

std::vector<Instance> instances(const Scene& scene, const Watch& watch) {
    const std::vector<Transform> world = world_transforms(scene);
    std::vector<Instance> result;
    WatchedSteps steps(watch);
    const auto add = [&](const Instance& instance) {
        steps.add(1);
        if (!instance.world.is_finite()) {
            fail(
                ErrorCode::asset_malformed, fmt::format("nodes[{}]", instance.node),
                fmt::format("node {} stands at a transform that is not finite, once its parents' are applied",
                            instance.node));
        }
        result.push_back(instance);
    };
    walk(scene, scene.roots, [&](uint32_t n) {
        const Node& node = scene.nodes[n];
        if (!node.mesh) return;
        if (node.batch.empty()) add({*node.mesh, n, 0, world[n]});
        for (uint32_t i = 0; i < node.batch.size(); ++i) {
            add({*node.mesh, n, i, world[n] * node.batch[i]});
        }
    });
    return result;
}

uint64_t instance_count(const Scene& scene) {
    uint64_t count = 0;
    walk(scene, scene.roots, [&](uint32_t n) {
        const Node& node = scene.nodes[n];
        if (node.mesh) count += node.batch.empty() ? 1 : node.batch.size();
    });
    return count;
}

namespace {

// How far something reaches to each side: -x, -y, -z, x, y, z.
using Reach = std::array<double, 6>;

// How far a mesh reaches in the 26 directions of whole numbers from -1 to 1.
class Hull {
  public:
    Hull(const Mesh& mesh, WatchedSteps& steps) {
        reach_.fill(-std::numeric_limits<double>::infinity());
        for (const Vec3f& position : mesh.positions) {
            steps.add(1);
            size_t i = 0;
            for (const double x : {-position.x, 0.0F, position.x})
                for (const double y : {-position.y, 0.0F, position.y})
                    for (const double z : {-position.z, 0.0F, position.z}) {
                        reach_[i] = std::max(reach_[i], x + y + z);
                        ++i;
                    }
        }
    }

    // Never less than what the mesh reaches in any direction, but for rounding; equal in those 26. Reach is
    // subadditive, and every direction is a sum of three of them with factors that are not negative: (5, 3,
    // 1) is 2 (1, 0, 0) + 2 (1, 1, 0) + 1 (1, 1, 1).
    double bound(Vec3d direction) const {
        struct Axis {
            double size;
            size_t step;  // in reach_, towards where the direction points
        };
        const auto axis = [](double d, size_t step) { return Axis{std::abs(d), d < 0 ? 0 - step : step}; };
        std::array<Axis, 3> axes = {axis(direction.x, 9), axis(direction.y, 3), axis(direction.z, 1)};
        std::sort(axes.begin(), axes.end(), [](const Axis& a, const Axis& b) { return a.size > b.size; });
        double sum = 0;
        size_t at = middle;
        for (size_t i = 0; i < 3; ++i) {
            at += axes[i].step;
            const double factor = axes[i].size - (i < 2 ? axes[i + 1].size : 0);
            if (factor > 0) sum += factor * reach_[at];
        }
        return sum;
    }

  private:
    static constexpr size_t middle = 13;
    std::array<double, 27> reach_{};  // by x, y and z of the direction
};

Reach farthest_reach(const Transform& world, const Hull& hull) {
    Reach reach{};
    for (size_t axis = 0; axis < 3; ++axis) {
        const double* row = &world.m[4 * axis];
        reach[axis] = hull.bound({-row[0], -row[1], -row[2]}) - row[3];
        reach[axis + 3] = hull.bound({row[0], row[1], row[2]}) + row[3];
    }
    return reach;
}

class BoundsSearch {
  public:
    BoundsSearch(const Scene& scene, std::span<const Instance> instances, const Watch& watch)
        : scene_(scene), instances_(instances), steps_(watch) {
        std::vector<Hull> hulls;
        for (const Mesh& mesh : scene.meshes) hulls.emplace_back(mesh, steps_);
        farthest_.reserve(instances.size());
        for (const Instance& instance : instances) {
            steps_.add(1);
            farthest_.push_back(farthest_reach(instance.world, hulls[instance.mesh]));
        }
        reach_.fill(-std::numeric_limits<double>::infinity());
    }

    Bounds run() {
        for (size_t side = 0; side < 6; ++side) {
            const size_t i = outermost(side);
            for (size_t any = 0; any < 6; ++any) look_at(i, any);
        }
        for (size_t side = 0; side < 6; ++side) {
            for (const size_t i : candidates(side)) {
                if (!may_extend(i, side)) break;
                look_at(i, side);
            }
        }
        return box();
    }

  private:
    size_t outermost(size_t side) const {
        const auto found =
            std::max_element(farthest_.begin(), farthest_.end(),
                             [side](const Reach& a, const Reach& b) { return a[side] < b[side]; });
        return static_cast<size_t>(found - farthest_.begin());
    }

    // Thousands that stand on one ground reach equally far, but for rounding: one of them will do.
    bool may_extend(size_t i, size_t side) const {
        return farthest_[i][side] > reach_[side] + 1e-9 * box().diagonal();
    }

    // The farthest first, so that nearly all are left out.
    std::vector<size_t> candidates(size_t side) {
        std::vector<size_t> out;
        for (size_t i = 0; i < instances_.size(); ++i) {
            steps_.add(1);
            if (may_extend(i, side)) out.push_back(i);
        }
        std::stable_sort(out.begin(), out.end(), steps_.counting([&](size_t a, size_t b) {
            return farthest_[a][side] > farthest_[b][side];
        }));
        return out;
    }

    void look_at(size_t i, size_t side) {
        const double* row = &instances_[i].world.m[4 * (side % 3)];
        const double sign = side < 3 ? -1 : 1;
        double reach = reach_[side];
        const std::vector<Vec3f>& positions = scene_.meshes[instances_[i].mesh].positions;
        for (size_t begin = 0; begin < positions.size(); begin += watched_stride) {
            const size_t end = std::min(positions.size(), begin + watched_stride);
            steps_.add(end - begin);
            for (size_t k = begin; k < end; ++k) {
                const Vec3f& p = positions[k];
                reach = std::max(reach, sign * (row[0] * p.x + row[1] * p.y + row[2] * p.z + row[3]));
            }
        }
        reach_[side] = reach;
    }

    Bounds box() const { return {{-reach_[0], -reach_[1], -reach_[2]}, {reach_[3], reach_[4], reach_[5]}}; }

    const Scene& scene_;
    std::span<const Instance> instances_;
    WatchedSteps steps_;
    std::vector<Reach> farthest_;  // per instance
    Reach reach_;                  // of all that were looked at
};

}  // namespace

Bounds scene_bounds(const Scene& scene, std::span<const Instance> instances, const Watch& watch) {
    const Bounds box = instances.empty() ? Bounds{} : BoundsSearch(scene, instances, watch).run();
    require(std::isfinite(box.diagonal()), ErrorCode::asset_malformed, "nodes",
            "the scene reaches farther than numbers do: its box has no finite diagonal");
    return box;
}

Bounds scene_bounds(const Scene& scene, const Watch& watch) {
    return scene_bounds(scene, instances(scene, watch), watch);
}

}  // namespace coppice
