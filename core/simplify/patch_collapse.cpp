#include "core/simplify/patch_collapse.h"

#include <algorithm>
#include <tuple>

#include "core/base/watched_loop.h"

namespace coppice {

namespace {

constexpr uint32_t sample_size = 1024;  // vertices that a search looks at

}  // namespace

PatchCollapse::PatchCollapse(EdgeCollapse& work, const PatchOptions& options, const Watch& watch)
    : work_(work),
      mesh_(work.mesh()),
      options_(options),
      watch_(watch),
      patches_(mesh_, watch),
      inside_(mesh_.vertex_count()) {}

uint32_t PatchCollapse::count_inside(const CodebookSizes& sizes) {
    group(sizes);
    return static_cast<uint32_t>(std::count(inside_.begin(), inside_.end(), true));
}

double PatchCollapse::estimate_inside(const CodebookSizes& sizes) const {
    const Codebook codebook(sizes, options_.warp, 6 * std::min(sample_size, mesh_.vertex_count()), watch_);
    const uint32_t stride = 1 + mesh_.live_vertices() / sample_size;
    uint64_t inside = 0;
    uint32_t live = 0;
    watched_loop(mesh_.vertex_count(), watch_, [&](size_t i) {
        const auto v = static_cast<uint32_t>(i);
        if (!mesh_.is_live_vertex(v) || live++ % stride != 0) return;
        inside += is_removable(v) && patches_.is_inside(v, codebook) ? 1 : 0;
    });
    return static_cast<double>(inside * stride);
}

void PatchCollapse::group(const CodebookSizes& sizes) {
    patches_.group(Codebook(sizes, options_.warp, mesh_.live_triangles(), watch_), options_.refinements,
                   watch_);
    watched_loop(mesh_.vertex_count(), watch_, [&](size_t v) {
        const auto vertex = static_cast<uint32_t>(v);
        inside_[v] = is_removable(vertex) && patches_.patch_around(vertex) != no_index;
    });
    seed_closed_patches();
}

bool PatchCollapse::is_removable(uint32_t vertex) const {
    return mesh_.is_live_vertex(vertex) && work_.kind(vertex) == VertexKind::manifold &&
           mesh_.valence(vertex) <= largest_removable_valence;
}

// A patch without an edge (two layers wound alike) gets one vertex of it: an outermost one.
void PatchCollapse::seed_closed_patches() {
    std::vector<bool> has_edge(patches_.patch_count());
    watched_loop(mesh_.triangle_count(), watch_, [&](size_t i) {
        const auto t = static_cast<uint32_t>(i);
        if (!mesh_.is_live_triangle(t)) return;
        for (uint32_t c = 3 * t; c < 3 * t + 3; ++c)
            if (!inside_[mesh_.corner_vertex(c)]) has_edge[patches_.patch(t)] = true;
    });
    if (std::find(has_edge.begin(), has_edge.end(), false) == has_edge.end()) return;
    const auto outermost_first = [this](uint32_t a, uint32_t b) {
        const Vec3d p = mesh_.position(a), q = mesh_.position(b);
        return std::tie(q.x, q.y, q.z, a) < std::tie(p.x, p.y, p.z, b);
    };
    std::vector<uint32_t> seeds(has_edge.size(), no_index);
    for (uint32_t v = 0; v < mesh_.vertex_count(); ++v) {
        if (!inside_[v] || has_edge[patches_.patch_around(v)]) continue;
        uint32_t& seed = seeds[patches_.patch_around(v)];
        if (seed == no_index || outermost_first(v, seed)) seed = v;
    }
    for (const uint32_t seed : seeds)
        if (seed != no_index) inside_[seed] = false;
}

void PatchCollapse::run(const CodebookSizes& sizes) {
    group(sizes);
    uint32_t before = 0;
    do {
        before = mesh_.live_vertices();
        CheapestFirst(*this, watch_).run();
        if (!options_.triangulate) return;
        // Other edges lead out of what was refused.
        work_.flip_edges([this](uint32_t s, uint32_t t) { return patches_.patch(s) == patches_.patch(t); },
                         watch_);
    } while (!work_.done() && before - mesh_.live_vertices() > before / 1000);
}

Candidate PatchCollapse::next_candidate(uint32_t owner, std::optional<Candidate> after) {
    Candidate best;
    if (!inside_[owner]) {
        if (is_removable(owner)) work_.refuse_beyond_threshold();
        return best;
    }
    work_.ring(owner, ring_);
    for (const uint32_t other : ring_) {
        if (inside_[other]) continue;
        const Candidate candidate = {other, edge_length(owner, other)};
        if (!(after && !(*after < candidate)) && candidate < best) best = candidate;
    }
    return best;
}

std::optional<double> PatchCollapse::cost(uint32_t owner, uint32_t other) const {
    if (!inside_[owner] || inside_[other]) return {};
    return edge_length(owner, other);
}

double PatchCollapse::edge_length(uint32_t a, uint32_t b) const {
    return length(mesh_.position(a) - mesh_.position(b));
}

}  // namespace coppice
