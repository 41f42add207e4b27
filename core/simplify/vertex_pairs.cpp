#include "core/simplify/vertex_pairs.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>

#include "core/base/watched_loop.h"

namespace coppice {

namespace {

constexpr size_t most_pairs = 8;         // of a vertex
constexpr uint32_t most_looked_at = 64;  // in a bucket
constexpr size_t crowded = 4;            // vertices of a cell, in the mean
// Coordinates of cells in the box take 20 bits, with room for what lies a little outside.
constexpr double most_cells_across = 1 << 20;
constexpr int64_t outside = 1 << 16;

uint64_t packed(int64_t x, int64_t y, int64_t z) {
    const auto part = [](int64_t i) { return static_cast<uint64_t>(i + outside); };
    return part(x) << 42 | part(y) << 21 | part(z);
}

struct Near {
    double squared_distance = 0;
    uint32_t vertex = no_index;

    friend bool operator<(const Near& a, const Near& b) {
        return a.squared_distance != b.squared_distance ? a.squared_distance < b.squared_distance
                                                        : a.vertex < b.vertex;
    }
};

}  // namespace

VertexPairs::VertexPairs(const CollapseMesh& mesh, const std::vector<FeatureEdge>& edges, const Watch& watch)
    : mesh_(mesh),
      cells_(watched_vector(mesh.vertex_count(), watch, never)),
      after_(watched_vector(mesh.vertex_count(), watch, no_index)),
      before_(watched_vector(mesh.vertex_count(), watch, no_index)) {
    watched_loop(edges.size(), watch, [&](size_t i) {
        if (edges[i].is_border) cells_[edges[i].a] = cells_[edges[i].b] = 0;
    });
    watched_loop(mesh.vertex_count(), watch, [&](size_t v) {
        if (cells_[v] != never) members_.push_back(static_cast<uint32_t>(v));
    });
    heads_.resize(std::bit_ceil(members_.size() + 1));
}

void VertexPairs::set_distance(double distance, const Watch& watch) {
    distance_ = distance;
    const double diagonal = mesh_.box().diagonal();
    edge_ = diagonal > 0 ? std::clamp(distance, diagonal / (most_cells_across / 2), diagonal) : distance;
    const auto is_gone = [this](uint32_t v) { return !contains(v); };
    members_.erase(std::remove_if(members_.begin(), members_.end(), is_gone), members_.end());
    fill(watch);
    while (members_.size() > crowded * filled_ && diagonal < edge_ * most_cells_across / 4) {
        edge_ /= 2;
        fill(watch);
    }
}

void VertexPairs::fill(const Watch& watch) {
    heads_.assign(heads_.size(), no_index);
    filled_ = 0;
    watched_loop(members_.size(), watch, [&](size_t i) { insert(members_[i]); });
}

void VertexPairs::insert(uint32_t vertex) {
    cells_[vertex] = cell_at(mesh_.position(vertex));
    uint32_t& head = heads_[bucket_of(cells_[vertex])];
    filled_ += head == no_index;
    before_[vertex] = no_index;
    after_[vertex] = head;
    if (head != no_index) before_[head] = vertex;
    head = vertex;
}

void VertexPairs::erase(uint32_t vertex) {
    if (!contains(vertex)) return;
    const uint32_t before = before_[vertex], after = after_[vertex];
    (before == no_index ? heads_[bucket_of(cells_[vertex])] : after_[before]) = after;
    if (after != no_index) before_[after] = before;
    cells_[vertex] = gone;
}

void VertexPairs::move(uint32_t vertex) {
    if (!contains(vertex)) return;
    erase(vertex);
    insert(vertex);
}

uint64_t VertexPairs::cell_at(Vec3d position) const {
    const Vec3d p = (position - mesh_.box().min) * (1 / edge_);
    return packed(static_cast<int64_t>(std::floor(p.x)), static_cast<int64_t>(std::floor(p.y)),
                  static_cast<int64_t>(std::floor(p.z)));
}

size_t VertexPairs::bucket_of(uint64_t cell) const {
    const uint64_t mixed = (cell ^ (cell >> 31)) * 0x9e3779b97f4a7c15ULL;
    return (mixed >> 32) & (heads_.size() - 1);
}

void VertexPairs::append(uint32_t vertex, std::vector<uint32_t>& out) const {
    if (!contains(vertex)) return;
    const Vec3d position = mesh_.position(vertex);
    const auto ring = static_cast<std::ptrdiff_t>(out.size());
    std::array<Near, most_pairs> nearest;
    size_t count = 0;
    const auto look_at = [&](uint32_t other) {
        const Near near = {squared_length(mesh_.position(other) - position), other};
        if (near.squared_distance > distance_ * distance_ || other == vertex) return;
        if (count == most_pairs && !(near < nearest.back())) return;
        if (std::find(out.begin(), out.begin() + ring, other) != out.begin() + ring) return;
        size_t place = count < most_pairs ? count++ : count - 1;
        for (; place > 0 && near < nearest[place - 1]; --place) nearest[place] = nearest[place - 1];
        nearest[place] = near;
    };
    const uint64_t own = cells_[vertex];
    for (int64_t step = 0; step < 27; ++step) {
        // Neighbouring cells differ by one in each part of the packed number.
        const int64_t x = step / 9 - 1, y = step / 3 % 3 - 1, z = step % 3 - 1;
        const uint64_t cell =
            own + static_cast<uint64_t>(x * (int64_t{1} << 42) + y * (int64_t{1} << 21) + z);
        uint32_t left = most_looked_at;
        for (uint32_t v = heads_[bucket_of(cell)]; v != no_index && left > 0; v = after_[v], --left)
            if (cells_[v] == cell) look_at(v);
    }
    for (size_t i = 0; i < count; ++i) out.push_back(nearest[i].vertex);
}

}  // namespace coppice
