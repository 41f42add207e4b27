// Asking where a mesh's surface is, for tests that compare two meshes.
#pragma once

#include <cstdint>
#include <vector>

#include "core/mesh/bounds.h"
#include "core/mesh/mesh.h"

namespace coppice::test {

struct Segment {
    Vec3d a, b;
};

double distance(Vec3d point, const Segment& segment);
double distance(Vec3d point, Vec3d a, Vec3d b, Vec3d c);  // to a triangle

// A tree of boxes over triangles (or segments, as triangles without area). Immutable; keeps no reference to
// the mesh.
class Surface {
  public:
    struct Triangle {
        Vec3d a, b, c;
    };

    explicit Surface(const Mesh& mesh);
    explicit Surface(const std::vector<Segment>& segments);

    bool empty() const { return triangles_.empty(); }
    double distance_to(Vec3d point) const;  // infinity when empty
    // Indices of the triangles no farther away than that, in no particular order.
    std::vector<uint32_t> within(Vec3d point, double radius) const;
    const Triangle& triangle(uint32_t index) const { return triangles_[index]; }

  private:
    struct Box {
        Bounds bounds = {};
        uint32_t begin = 0, end = 0;  // in order_
        uint32_t left = 0;            // the children are left and left + 1; 0: a leaf
    };

    void build();

    std::vector<Triangle> triangles_;
    std::vector<uint32_t> order_;
    std::vector<Box> boxes_;
};

}  // namespace coppice::test
