// The vertices around a vertex, with how often its triangles use the edge to each. Reused scratch: no
// allocation once it has grown.
#pragma once

#include <cstdint>
#include <utility>
#include <vector>

#include "core/base/watched_loop.h"
#include "core/simplify/collapse_mesh.h"

namespace coppice {

// Triangles at the edge between two vertices; 0 where there is none, no_index where both have so many
// triangles that a search would take long.
inline uint32_t edge_uses(const CollapseMesh& mesh, uint32_t v, uint32_t w) {
    constexpr uint32_t longest_search = 64;
    if (mesh.valence(v) > mesh.valence(w)) std::swap(v, w);
    if (mesh.valence(v) > longest_search) return no_index;
    uint32_t uses = 0;
    for (uint32_t c = mesh.first_corner(v); c != no_index; c = mesh.corner_after(c)) {
        uses += mesh.corner_vertex(CollapseMesh::next_corner(c)) == w ||
                mesh.corner_vertex(CollapseMesh::previous_corner(c)) == w;
    }
    return uses;
}

class Neighbours {
  public:
    explicit Neighbours(uint32_t vertex_count, const Watch& watch = {})
        : marks_(watched_vector<Mark>(vertex_count, watch)) {}

    // Forgets the last vertex and gathers the neighbours of this one, in the order of its corners.
    void gather(const CollapseMesh& mesh, uint32_t vertex) {
        begin(mesh.valence(vertex));
        for (uint32_t c = mesh.first_corner(vertex); c != no_index; c = mesh.corner_after(c)) {
            add(mesh.corner_vertex(CollapseMesh::next_corner(c)));
            add(mesh.corner_vertex(CollapseMesh::previous_corner(c)));
        }
    }

    // The same, counted, for vertices that may have very many triangles.
    void gather(const CollapseMesh& mesh, uint32_t vertex, WatchedSteps& steps) {
        begin(mesh.valence(vertex));
        for (uint32_t c = mesh.first_corner(vertex); c != no_index; c = mesh.corner_after(c)) {
            steps.add(1);
            add(mesh.corner_vertex(CollapseMesh::next_corner(c)));
            add(mesh.corner_vertex(CollapseMesh::previous_corner(c)));
        }
    }

    const std::vector<uint32_t>& all() const { return list_; }
    bool contains(uint32_t vertex) const { return find(vertex) != no_index; }
    // Triangles at the edge to this vertex; 0 when there is none.
    uint32_t uses(uint32_t vertex) const {
        const uint32_t i = find(vertex);
        return i == no_index ? 0 : uses_[i];
    }
    // Position in all(); no_index when it is not there.
    uint32_t find(uint32_t vertex) const {
        if (marked_) return marks_[vertex].round == round_ ? marks_[vertex].place : no_index;
        for (uint32_t i = 0; i < list_.size(); ++i) {
            if (list_[i] == vertex) return i;
        }
        return no_index;
    }

  private:
    // A short list is searched, which stays in the cache; vertices of a long one are marked.
    static constexpr uint32_t long_ring = 16;

    struct Mark {
        uint32_t round = 0;
        uint32_t place = 0;
    };

    void begin(uint32_t valence) {
        list_.clear();
        uses_.clear();
        marked_ = valence > long_ring;
        if (++round_ == 0) {  // after 2^32 rounds
            marks_.assign(marks_.size(), Mark{});
            round_ = 1;
        }
    }
    void add(uint32_t vertex) {
        const uint32_t i = find(vertex);
        if (i != no_index) {
            ++uses_[i];
            return;
        }
        if (marked_) marks_[vertex] = {round_, static_cast<uint32_t>(list_.size())};
        list_.push_back(vertex);
        uses_.push_back(1);
    }

    std::vector<Mark> marks_;  // per vertex of the mesh
    std::vector<uint32_t> list_, uses_;
    uint32_t round_ = 0;
    bool marked_ = false;
};

}  // namespace coppice
