#include "core/simplify/normal_patches.h"

#include <algorithm>
#include <functional>

#include "core/base/watched_loop.h"

namespace coppice {

namespace {

uint32_t root(std::vector<uint32_t>& parents, uint32_t i) {
    while (parents[i] != i) i = parents[i] = parents[parents[i]];
    return i;
}

// An edge at its lower end, as a triangle has it.
struct HalfEdge {
    uint32_t upper = 0, corner = 0;

    friend bool operator<(const HalfEdge& p, const HalfEdge& q) {
        return p.upper != q.upper ? p.upper < q.upper : p.corner < q.corner;
    }
};

}  // namespace

NormalPatches::NormalPatches(const CollapseMesh& mesh, const Watch& watch)
    : mesh_(mesh),
      normals_(watched_vector<Vec3f>(mesh.triangle_count(), watch)),
      neighbours_(watched_vector(3 * size_t{mesh.triangle_count()}, watch, no_index)),
      patches_(watched_vector(mesh.triangle_count(), watch, no_index)),
      parents_(watched_vector<uint32_t>(mesh.triangle_count(), watch)) {
    for_each_triangle(mesh, watch, [&](uint32_t t, const std::array<uint32_t, 3>& v) {
        normals_[t] =
            to_float(normalized(area_normal(mesh.position(v[0]), mesh.position(v[1]), mesh.position(v[2]))));
    });
    connect(watch);
}

void NormalPatches::connect(const Watch& watch) {
    const auto for_each_edge = [&](auto&& use) {
        for_each_triangle(mesh_, watch, [&](uint32_t t, const std::array<uint32_t, 3>& v) {
            for (uint32_t k = 0; k < 3; ++k) {
                const auto [low, high] = std::minmax(v[k], v[(k + 1) % 3]);
                use(low, high, 3 * t + k);
            }
        });
    };
    std::vector<uint32_t> ends(size_t{mesh_.vertex_count()} + 1);  // of each lower end's edges
    for_each_edge([&](uint32_t lower, uint32_t, uint32_t) { ++ends[lower + 1]; });
    for (size_t v = 1; v < ends.size(); ++v) ends[v] += ends[v - 1];
    auto edges = watched_vector<HalfEdge>(ends.back(), watch);
    WatchedSteps steps(watch);
    for_each_edge([&](uint32_t lower, uint32_t upper, uint32_t corner) {
        edges[ends[lower]++] = {upper, corner};
    });
    watched_loop(mesh_.vertex_count(), watch, [&](size_t v) {
        const auto first = edges.begin() + (v > 0 ? ends[v - 1] : 0), last = edges.begin() + ends[v];
        std::sort(first, last, steps.counting(std::less<>()));
        for (auto run = first, end = first; run != last; run = end) {
            while (end != last && end->upper == run->upper) ++end;
            if (end - run != 2) continue;
            neighbours_[run->corner] = (run + 1)->corner / 3;
            neighbours_[(run + 1)->corner] = run->corner / 3;
        }
    });
}

bool NormalPatches::is_inside(uint32_t vertex, const Codebook& codebook) const {
    uint32_t nearest = no_index;
    for (uint32_t c = mesh_.first_corner(vertex); c != no_index; c = mesh_.corner_after(c)) {
        const Vec3f normal = normals_[c / 3];
        if (normal == Vec3f{}) continue;
        const uint32_t here = codebook.nearest(to_double(normal));
        if (nearest != no_index && here != nearest) return false;
        nearest = here;
    }
    return true;
}

void NormalPatches::group(const Codebook& codebook, uint32_t refinements, const Watch& watch) {
    quantize(codebook, watch);
    split_into_components(watch);
    for (uint32_t i = 0; i < refinements && move_to_nearer_means(watch); ++i) split_into_components(watch);
}

void NormalPatches::quantize(const Codebook& codebook, const Watch& watch) {
    watched_loop(normals_.size(), watch, [&](size_t t) {
        patches_[t] = normals_[t] == Vec3f{} ? no_index : codebook.nearest(to_double(normals_[t]));
    });
    spread_labels();
}

// To triangles without area, from those with any.
void NormalPatches::spread_labels() {
    std::vector<uint32_t> reached;
    const auto reach = [&](uint32_t t) {
        for (uint32_t c = 3 * t; c < 3 * t + 3 && patches_[t] == no_index; ++c)
            if (neighbours_[c] != no_index) patches_[t] = patches_[neighbours_[c]];
        if (patches_[t] != no_index) reached.push_back(t);
    };
    for (uint32_t t = 0; t < patches_.size(); ++t)
        if (patches_[t] == no_index && mesh_.is_live_triangle(t)) reach(t);
    while (!reached.empty()) {
        const uint32_t t = reached.back();
        reached.pop_back();
        for (uint32_t c = 3 * t; c < 3 * t + 3; ++c) {
            const uint32_t neighbour = neighbours_[c];
            if (neighbour != no_index && patches_[neighbour] == no_index) reach(neighbour);
        }
    }
}

void NormalPatches::split_into_components(const Watch& watch) {
    watched_loop(parents_.size(), watch, [&](size_t t) {
        parents_[t] = static_cast<uint32_t>(t);
        if (!mesh_.is_live_triangle(parents_[t])) return;
        // With the lower ones: those across an edge are the same from both sides.
        for (size_t c = 3 * t; c < 3 * t + 3; ++c) {
            const uint32_t neighbour = neighbours_[c];
            if (neighbour >= t || patches_[neighbour] != patches_[t]) continue;
            const uint32_t a = root(parents_, parents_[t]), b = root(parents_, neighbour);
            parents_[std::max(a, b)] = std::min(a, b);
        }
    });
    // Roots come first, being the lowest.
    patch_count_ = 0;
    watched_loop(parents_.size(), watch, [&](size_t t) {
        if (!mesh_.is_live_triangle(static_cast<uint32_t>(t))) return;
        const uint32_t r = root(parents_, static_cast<uint32_t>(t));
        patches_[t] = r == t ? patch_count_++ : patches_[r];
    });
}

// All at once. False where all stay.
bool NormalPatches::move_to_nearer_means(const Watch& watch) {
    std::vector<Vec3d> means(patch_count_);
    watched_loop(normals_.size(), watch, [&](size_t t) {
        if (!mesh_.is_live_triangle(static_cast<uint32_t>(t))) return;
        means[patches_[t]] = means[patches_[t]] + to_double(normals_[t]);
    });
    for (Vec3d& mean : means) mean = normalized(mean);
    std::vector<uint32_t>& moved = parents_;
    bool any = false;
    watched_loop(normals_.size(), watch, [&](size_t t) {
        moved[t] = patches_[t];
        if (!mesh_.is_live_triangle(static_cast<uint32_t>(t))) return;
        const Vec3d normal = to_double(normals_[t]);
        double most = dot(normal, means[moved[t]]);
        for (size_t c = 3 * t; c < 3 * t + 3; ++c) {
            if (neighbours_[c] == no_index) continue;
            const uint32_t patch = patches_[neighbours_[c]];
            if (patch == moved[t] || !(dot(normal, means[patch]) > most)) continue;
            most = dot(normal, means[patch]);
            moved[t] = patch;
            any = true;
        }
    });
    patches_.swap(moved);
    return any;
}

uint32_t NormalPatches::patch_around(uint32_t vertex) const {
    uint32_t patch = no_index;
    for (uint32_t c = mesh_.first_corner(vertex); c != no_index; c = mesh_.corner_after(c)) {
        if (patch != no_index && patches_[c / 3] != patch) return no_index;
        patch = patches_[c / 3];
    }
    return patch;
}

}  // namespace coppice
