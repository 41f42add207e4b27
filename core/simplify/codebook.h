// The codebooks of GAEA: unit vectors all around, that normals are quantized to. G. Subramaniam, K. Ong,
// APVIS 2006, section 2.1: a cube whose faces are grids of x, y and z cells along the axes, blown up to a
// sphere; the code-vectors are the normals of its 2(xy + yz + zx) quads.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "core/base/watch.h"
#include "core/mesh/vec.h"

namespace coppice {

// Cells along x, y and z; at least 1 each.
using CodebookSizes = std::array<uint32_t, 3>;

uint64_t code_vector_count(const CodebookSizes& sizes);

// Where the lines of the grids are: at even steps of the cube, as printed, or of the angle. The paper calls
// its vectors equiangular, which neither is: nearest neighbours of 5-5-5 are 12.5 to 20.4 degrees apart with
// flat, 14.7 to 17.6 with tan.
enum class Warp : uint8_t { flat, tan };

class Codebook {
  public:
    // lookups: how many there will be, about; more time is spent here the more there are.
    Codebook(const CodebookSizes& sizes, Warp warp, uint64_t lookups, const Watch& watch = {});

    std::span<const Vec3d> vectors() const { return vectors_; }

    // Index of the code-vector at the least angle to a direction of any length; the lower one of two. Exact.
    // Takes the time of the few vectors that are near.
    uint32_t nearest(Vec3d direction) const;

  private:
    void add_vectors(const CodebookSizes& sizes, Warp warp);
    void split_cells(const Watch& watch);
    std::span<const uint32_t> candidates(uint64_t cell) const {
        return std::span(candidates_).subspan(begins_[cell], begins_[cell + 1] - begins_[cell]);
    }

    std::vector<Vec3d> vectors_;
    // Directions in cells, resolution_^2 on each face of a cube, each with the vectors that are nearest to
    // any direction in it, ascending.
    uint32_t resolution_ = 1;
    std::vector<uint32_t> begins_, candidates_;
};

}  // namespace coppice
