// Meshes from loose corners: positions that meet are one vertex, corners that agree are one wedge.
#pragma once

#include <cstdint>
#include <functional>
#include <limits>
#include <string>
#include <vector>

#include "core/mesh/mesh.h"

namespace coppice {

// A corner's normal is that of its own triangle, not an average.
constexpr uint32_t flat = std::numeric_limits<uint32_t>::max();

struct Corner {
    Vec3d position;
    double u = 0, v = 0;
    uint32_t smoothing =
        0;  // normals are averaged over the triangles around a vertex that share this group, or flat
};

class MeshBuilder {
  public:
    explicit MeshBuilder(std::string name) : name_(std::move(name)) {}

    uint32_t add_slot(uint32_t material);  // -> its index

    // Counter-clockwise seen from outside. Skipped where two corners coincide, as at the poles of a loft.
    void triangle(uint32_t slot, const Corner& a, const Corner& b, const Corner& c);
    void quad(uint32_t slot, const Corner& a, const Corner& b, const Corner& c,
              const Corner& d);  // shorter diagonal

    // rows x columns quads between corner(row, column), both ends included; outside is where rows x columns
    // points.
    void patch(uint32_t slot, uint32_t rows, uint32_t columns,
               const std::function<Corner(uint32_t row, uint32_t column)>& corner);

    Mesh finish() const;  // slots without triangles are kept out

  private:
    std::string name_;
    std::vector<uint32_t> materials_;
    std::vector<Corner> corners_;  // 3 per triangle, positions snapped
    std::vector<uint32_t> slots_;  // one per triangle
};

}  // namespace coppice
