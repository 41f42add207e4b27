// Procedural scenes: for trying coppice out, and for tests that need instancing, texture seams and watertight
// meshes without any file. Every sample is made whole from its options; nothing is read.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string_view>

#include "core/scene/scene.h"

namespace coppice {

struct SampleOptions {
    uint64_t seed = 1;                       // another seed: other shapes and places, the same counts
    double scale = 1;                        // multiplies the sample's default copies and default triangles
    std::optional<uint32_t> copies = {};     // instances of the repeated meshes, over all of them
    std::optional<uint32_t> triangles = {};  // of each repeated mesh, approximately
    bool joined = false;  // everything in one mesh, as exporters that know no instancing do
};

struct SampleKind {
    std::string_view name;
    std::string_view title;
    uint32_t copies;     // at scale 1
    uint32_t triangles;  // at scale 1
};

// forest, city, bunny13, baked, cad.
std::span<const SampleKind> sample_kinds();

// The same options give the same scene. y is up, as in glTF. Meshes have NORMAL and TEXCOORD_0 with real
// seams, no degenerate triangle, and are watertight unless their making says otherwise (grounds; the bunny
// has four small holes, like the real one). Throws option_invalid for an unknown name or values out of range.
Scene make_sample(std::string_view name, const SampleOptions& options);

}  // namespace coppice
