// The rows of a PLY file as flat arrays.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "core/base/watch.h"
#include "core/format/limits.h"
#include "core/format/ply/ply_header.h"
#include "core/format/warning_tally.h"
#include "core/mesh/mesh.h"

namespace coppice {

struct PlyBody {
    std::vector<Vec3f> positions;
    std::vector<float> normals;  // 3 per vertex, or empty
    std::vector<float> uvs;      // 2 per vertex, as written (v up), or empty
    std::vector<float> colors;   // 3 or 4 per vertex, 0..1, or empty
    uint32_t color_components = 0;
    Storage color_storage = {};
    std::vector<uint32_t> triangles;         // 3 vertices each
    std::vector<uint32_t> triangle_texture;  // per triangle; empty when faces have no texnumber
    std::vector<float> corner_uvs;           // 2 per corner of triangles; empty when faces have no texcoord
};

// Every index of the result is in range, every position finite.
PlyBody read_ply_body(ByteView bytes, const PlyHeader& header, const ReadLimits& limits, const Watch& watch,
                      WarningTally& tally);

}  // namespace coppice
