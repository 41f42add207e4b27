// What a reader refuses before it allocates. Defaults as documented in docs/operations.md; every refusal
// names the limit. All of them are settings.
#pragma once

#include <cstdint>

namespace coppice {

struct ReadLimits {
    uint64_t triangles = 20'000'000;            // stored, over all unique meshes
    uint64_t rendered_triangles = 200'000'000;  // after expansion of instances
    uint64_t instances = 5'000'000;
    uint64_t vertices = 30'000'000;
    uint64_t json_bytes = 64ULL << 20;
    uint64_t json_values = 8'000'000;  // each takes up to 200 bytes of memory
    uint32_t json_depth = 64;
    uint32_t nodes = 100'000;
    uint32_t node_depth = 128;
    uint32_t meshes_and_primitives = 65'536;
    uint32_t accessors = 200'000;  // and as many buffer views
    uint32_t objects = 200'000;    // of all other kinds together, from scenes to the channels of animations
    uint32_t attributes = 1024;    // of a mesh, over all its primitives and morph targets
    // Of all accessors as they are stored, of all attributes as floats, and of what Draco decodes to.
    uint64_t attribute_bytes = 1ULL << 30;
    uint32_t images = 512;
    uint32_t zip_entries = 2000;
    uint64_t zip_bytes = 1ULL << 30;  // unpacked
    uint32_t zip_ratio = 100;         // unpacked : packed
};

}  // namespace coppice
