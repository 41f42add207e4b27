#include "core/compare/bvh.h"

#include <algorithm>
#include <numeric>
#include <optional>

#include "core/base/parallel.h"
#include "core/base/watched_loop.h"

namespace coppice {

namespace {

constexpr size_t leaf_size = 4;
constexpr size_t bin_count = 16;

// Towards minus or plus infinity, where a float cannot hold the number.
float round_down(double value) {
    const auto rounded = static_cast<float>(std::max(value, -double{std::numeric_limits<float>::max()}));
    return double{rounded} > value ? std::nextafterf(rounded, -std::numeric_limits<float>::infinity())
                                   : rounded;
}

float round_up(double value) {
    return -round_down(-value);
}

}  // namespace

void Bvh::Box::extend(const Box& other) {
    for (size_t axis = 0; axis < 3; ++axis) {
        min[axis] = std::min(min[axis], other.min[axis]);
        max[axis] = std::max(max[axis], other.max[axis]);
    }
}

double Bvh::Box::half_area() const {
    const double x = double{max[0]} - min[0], y = double{max[1]} - min[1], z = double{max[2]} - min[2];
    return x * y + y * z + z * x;
}

Bvh::Box Bvh::box_of(const std::array<Vec3d, 3>& corners) {
    const auto [low, high] = [&] {
        Bounds box;
        for (const Vec3d& corner : corners) box.extend(corner);
        return std::pair(box.min, box.max);
    }();
    return {{round_down(low.x), round_down(low.y), round_down(low.z)},
            {round_up(high.x), round_up(high.y), round_up(high.z)}};
}

// Splits ranges of `order_`. The upper part of the tree is built alone, what is below it in parallel.
class Bvh::Builder {
  public:
    Builder(const Surface& surface, unsigned threads, const Watch& watch)
        : threads_(threads),
          watch_(watch),
          boxes_(surface.triangle_count()),
          scratch_(boxes_.size()),
          order_(boxes_.size()) {
        std::iota(order_.begin(), order_.end(), 0U);
        watched_loop(boxes_.size(), watch, [&](size_t t) { boxes_[t] = box_of(surface.corners(t)); });
    }

    std::vector<Node> build() {
        const auto count = static_cast<uint32_t>(order_.size());
        std::vector<Node> nodes(1);
        const uint32_t small = std::max(4096U, count / 64);
        const std::vector<Range> tasks = split_all({{0, 0, count, 0}}, small, nodes);
        std::vector<std::vector<Node>> below(tasks.size());
        parallel_for(tasks.size(), threads_, [&](size_t i) {
            below[i].resize(1);
            split_all({{0, tasks[i].begin, tasks[i].end, tasks[i].depth}}, 0, below[i]);
        });
        for (size_t i = 0; i < tasks.size(); ++i) hang(below[i], tasks[i].node, nodes);
        return nodes;
    }

    const std::vector<uint32_t>& order() const { return order_; }

  private:
    // Splits down to leaves, or to ranges no larger than `small`, which are returned.
    std::vector<Range> split_all(std::vector<Range> stack, uint32_t small, std::vector<Node>& nodes) {
        std::vector<Range> rest;
        while (!stack.empty()) {
            const Range range = stack.back();
            stack.pop_back();
            if (small > 0 && range.end - range.begin <= small) {
                rest.push_back(range);
                continue;
            }
            nodes[range.node].box = box_of_range(range);
            if (range.end - range.begin <= leaf_size) {
                nodes[range.node].begin = range.begin;
                nodes[range.node].count = range.end - range.begin;
                continue;
            }
            const uint32_t middle = split(range);
            const auto child = static_cast<uint32_t>(nodes.size());
            nodes[range.node].begin = child;
            nodes.resize(nodes.size() + 2);
            stack.push_back({child + 1, middle, range.end, range.depth + 1});
            stack.push_back({child, range.begin, middle, range.depth + 1});
        }
        return rest;
    }

    // A tree that was built alone takes the place of a node.
    static void hang(const std::vector<Node>& tree, uint32_t place, std::vector<Node>& nodes) {
        const auto shift = static_cast<uint32_t>(nodes.size()) - 1;
        const auto moved = [shift](Node node) {
            if (node.count == 0) node.begin += shift;
            return node;
        };
        nodes[place] = moved(tree[0]);
        for (size_t i = 1; i < tree.size(); ++i) nodes.push_back(moved(tree[i]));
    }

    Box box_of_range(const Range& range) const {
        Box box = boxes_[order_[range.begin]];
        watched_loop(range.end - range.begin, watch_,
                     [&](size_t i) { box.extend(boxes_[order_[range.begin + i]]); });
        return box;
    }

    double center(uint32_t triangle, size_t axis) const {
        return double{boxes_[triangle].min[axis]} + boxes_[triangle].max[axis];
    }

    struct Bins {
        size_t axis = 0;
        double low = 0, per_length = 0;

        size_t of(double center) const {
            return std::min(bin_count - 1, static_cast<size_t>((center - low) * per_length));
        }
    };

    std::optional<Bins> bins_along(const Range& range, size_t axis) const {
        double low = std::numeric_limits<double>::infinity(), high = -low;
        for (uint32_t i = range.begin; i < range.end; ++i) {
            low = std::min(low, center(order_[i], axis));
            high = std::max(high, center(order_[i], axis));
        }
        const double per_length = static_cast<double>(bin_count) / (high - low);
        if (!(high > low) || !std::isfinite(per_length)) return {};
        return Bins{axis, low, per_length};
    }

    struct Plane {
        Bins bins;
        size_t first_right = 0;  // bin
        double cost = std::numeric_limits<double>::infinity();
    };

    Plane best_plane(const Range& range) const {
        Plane best;
        for (size_t axis = 0; axis < 3; ++axis) {
            watch_.check();
            const std::optional<Bins> bins = bins_along(range, axis);
            if (!bins) continue;
            std::array<std::optional<Box>, bin_count> boxes;
            std::array<uint32_t, bin_count> counts{};
            watched_loop(range.end - range.begin, watch_, [&](size_t i) {
                const uint32_t triangle = order_[range.begin + i];
                const size_t bin = bins->of(center(triangle, axis));
                ++counts[bin];
                boxes[bin] ? boxes[bin]->extend(boxes_[triangle])
                           : static_cast<void>(boxes[bin] = boxes_[triangle]);
            });
            consider(*bins, boxes, counts, best);
        }
        return best;
    }

    static void consider(const Bins& bins, const std::array<std::optional<Box>, bin_count>& boxes,
                         const std::array<uint32_t, bin_count>& counts, Plane& best) {
        std::array<double, bin_count> right_cost{};
        std::optional<Box> box;
        uint32_t count = 0;
        const auto add = [&](size_t bin) {
            if (boxes[bin]) box ? box->extend(*boxes[bin]) : static_cast<void>(box = boxes[bin]);
            count += counts[bin];
            return count == 0 ? std::numeric_limits<double>::infinity() : box->half_area() * count;
        };
        for (size_t bin = bin_count - 1; bin > 0; --bin) right_cost[bin] = add(bin);
        box.reset();
        count = 0;
        for (size_t bin = 0; bin + 1 < bin_count; ++bin) {
            const double cost = add(bin) + right_cost[bin + 1];
            if (cost < best.cost) best = {bins, bin + 1, cost};
        }
    }

    // The first of the right part; neither part is empty.
    uint32_t split(const Range& range) {
        const uint32_t half = range.begin + (range.end - range.begin) / 2;
        if (range.depth >= deepest_bins) return half;
        const Plane plane = best_plane(range);
        if (!std::isfinite(plane.cost)) return half;
        // Stable, for the same tree from the same order.
        uint32_t left = range.begin, right = 0;
        watched_loop(range.end - range.begin, watch_, [&](size_t i) {
            const uint32_t triangle = order_[range.begin + i];
            if (plane.bins.of(center(triangle, plane.bins.axis)) < plane.first_right) {
                order_[left++] = triangle;
            } else {
                scratch_[range.begin + right++] = triangle;
            }
        });
        std::copy_n(scratch_.begin() + range.begin, right, order_.begin() + left);
        return left;
    }

    unsigned threads_;
    const Watch& watch_;
    std::vector<Box> boxes_;
    std::vector<uint32_t> scratch_;
    std::vector<uint32_t> order_;
};

Bvh::Bvh(Surface& surface, unsigned threads, const Watch& watch) : surface_(surface) {
    if (surface.triangle_count() == 0) return;
    Builder builder(surface, threads, watch);
    nodes_ = builder.build();
    reorder(surface, builder.order(), watch);
}

Bvh::Nearest Bvh::nearest(Vec3d p, uint32_t hint) const {
    Nearest best;
    best.point.squared_distance = std::numeric_limits<double>::infinity();
    const auto look_at = [&](uint32_t t) {
        const auto [a, b, c] = surface_.corners(t);
        const TrianglePoint point = closest_point(p, a, b, c);
        const bool is_nearer = point.squared_distance < best.point.squared_distance ||
                               (point.squared_distance == best.point.squared_distance && t < best.triangle);
        if (is_nearer) best = {t, point};
    };
    if (hint != none) look_at(hint);
    struct Entry {
        uint32_t node;
        double squared_distance;
    };
    std::array<Entry, std::tuple_size_v<Stack>> stack;
    size_t size = 0;
    stack[size++] = {0, 0};
    while (size > 0) {
        const Entry entry = stack[--size];
        // Equally near ones are looked at too, so that the first of them is found whatever the way to it.
        if (entry.squared_distance > best.point.squared_distance) continue;
        const Node& node = nodes_[entry.node];
        if (node.count > 0) {
            for (uint32_t t = node.begin; t < node.begin + node.count; ++t) look_at(t);
            continue;
        }
        Entry near = {node.begin, nodes_[node.begin].box.squared_distance(p)};
        Entry far = {node.begin + 1, nodes_[node.begin + 1].box.squared_distance(p)};
        if (far.squared_distance < near.squared_distance) std::swap(near, far);
        if (far.squared_distance <= best.point.squared_distance) stack[size++] = far;
        if (near.squared_distance <= best.point.squared_distance) stack[size++] = near;
    }
    return best;
}

}  // namespace coppice
