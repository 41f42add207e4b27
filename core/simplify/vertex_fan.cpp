#include "core/simplify/vertex_fan.h"

#include <algorithm>
#include <utility>

namespace coppice {

bool VertexFan::gather(const CollapseMesh& mesh, uint32_t vertex) {
    const size_t count = mesh.valence(vertex);
    corners_.resize(count), ring_.resize(count), ends_.resize(count);
    uint32_t* const corners = corners_.data();
    uint32_t* const begins = ring_.data();
    uint32_t* const ends = ends_.data();
    size_t i = 0;
    for (uint32_t c = mesh.first_corner(vertex); c != no_index; c = mesh.corner_after(c), ++i) {
        corners[i] = c;
        begins[i] = mesh.corner_vertex(CollapseMesh::next_corner(c));
        ends[i] = mesh.corner_vertex(CollapseMesh::previous_corner(c));
    }
    if (count == 0) return false;
    const auto to_place = [=](size_t place, size_t from) {
        std::swap(corners[place], corners[from]);
        std::swap(begins[place], begins[from]);
        std::swap(ends[place], ends[from]);
    };
    for (i = 0; i < count; ++i) {
        if (std::find(ends, ends + count, begins[i]) != ends + count) continue;
        to_place(0, i);  // a path starts here
        break;
    }
    for (i = 1; i < count; ++i) {
        const auto next = static_cast<size_t>(std::find(begins + i, begins + count, ends[i - 1]) - begins);
        if (next == count) return false;
        to_place(i, next);
    }
    closed_ = ends[count - 1] == begins[0];
    if (!closed_) ring_.push_back(ends_.back());
    for (auto v = ring_.begin(); v != ring_.end(); ++v)  // layers, or a vertex that is met twice
        if (std::find(v + 1, ring_.end(), *v) != ring_.end()) return false;
    return count > 2 || !closed_;
}

}  // namespace coppice
