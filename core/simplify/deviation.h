// How far the surface has moved: an estimate that is carried along with the collapses, not a bound.
#pragma once

#include <algorithm>
#include <cstdint>
#include <optional>
#include <vector>

#include "core/base/watched_loop.h"
#include "core/simplify/collapse_mesh.h"

namespace coppice {

// From a point to the nearest one between a and b.
template <typename T>
T distance_to_segment(Vec3<T> p, Vec3<T> a, Vec3<T> b) {
    const Vec3<T> edge = b - a;
    const T squared = squared_length(edge);
    const T along = squared > 0 ? std::clamp<T>(dot(p - a, edge) / squared, 0, 1) : 0;
    return length(p - (a + edge * along));
}

// Distance from a point to a triangle, inside and edges included.
double distance_to_triangle(Vec3d p, Vec3d a, Vec3d b, Vec3d c);

// The same where the nearest point of the triangle's plane is inside; else none.
std::optional<double> distance_from_above(Vec3d p, Vec3d a, Vec3d b, Vec3d c);

class Deviation {
  public:
    explicit Deviation(const CollapseMesh& mesh, const Watch& watch = {})
        : mesh_(mesh), carried_(watched_vector<double>(mesh.vertex_count(), watch)) {}

    // What the vertex that stays would stand for: the distance from the vertex that goes to the nearest
    // triangle that replaces its ring, on top of what that vertex has gathered before. The mesh is as before
    // the collapse.
    double after(uint32_t removed, uint32_t kept) const;

    double carried(uint32_t vertex) const { return carried_[vertex]; }

    // To be called with every collapse, with the result of after().
    void merge(uint32_t kept, double deviation);

    double largest() const { return largest_; }

  private:
    const CollapseMesh& mesh_;
    std::vector<double> carried_;  // per vertex, mesh units
    double largest_ = 0;
};

}  // namespace coppice
