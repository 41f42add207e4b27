// An OBJ file as it stands: statements resolved to flat arrays, nothing built from them yet.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "core/base/watch.h"
#include "core/format/iobj/directive.h"
#include "core/format/limits.h"
#include "core/mesh/vec.h"
#include "core/scene/scene.h"

namespace coppice {

constexpr uint32_t obj_none = 0xffffffff;

// Indices from 0 over the whole file; obj_none where the corner has none.
struct ObjCorner {
    uint32_t position = obj_none, uv = obj_none, normal = obj_none;

    friend bool operator==(const ObjCorner&, const ObjCorner&) = default;
};

// Consecutive faces of one object with one material.
struct ObjRun {
    uint32_t object = 0;           // index into objects
    uint32_t material = obj_none;  // index into materials
    size_t first_face = 0;         // up to the next run's, or the end
};

struct ObjFile {
    std::vector<Vec3f> positions;
    std::vector<Vec3f> colors;  // of the positions; empty when none has one, white where one has none
    std::vector<std::array<float, 2>> uvs;  // as written: v up
    std::vector<Vec3f> normals;
    std::vector<ObjCorner> corners;   // of all faces, one after the other
    std::vector<uint32_t> face_ends;  // of each face: one past its last corner
    std::vector<ObjRun> runs;
    std::vector<std::string> objects;    // names, in order; "default" is first where faces stand before any o
    std::vector<std::string> materials;  // names that usemtl uses, in order of first use
    std::vector<std::string> libraries;  // what mtllib lines say, one each, unsplit
    bool instanced = false;              // the file begins with #@iobj
    std::vector<InstanceDirective> instances;
    std::vector<Warning> warnings;

    uint32_t face_begin(size_t face) const { return face == 0 ? 0 : face_ends[face - 1]; }
};

// Throws asset_malformed with line and column, asset_too_large. Every index of the result is in range;
// positions are finite, other values repaired with a warning.
ObjFile parse_obj(std::string_view text, const ReadLimits& limits, const Watch& watch);

}  // namespace coppice
