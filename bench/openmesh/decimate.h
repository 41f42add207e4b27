// OpenMesh's quadric decimater, with one of its functions written anew without assertions: what the speed of
// others is measured by. Apart from the benchmarks, since it is compiled without their checks, and
// without those of Debian's library of OpenMesh.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

namespace coppice::peer {

struct Triangles {
    std::vector<double> positions;  // x y z of each vertex
    std::vector<uint32_t> corners;  // 3 vertices of each triangle
};

// From making its half-edges to collecting what is left; to at most so many triangles, which it returns.
size_t decimate_with_openmesh(const Triangles& mesh, size_t triangles);

}  // namespace coppice::peer
