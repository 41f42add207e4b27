// How large a Draco stream says its mesh is.
#pragma once

#include <cstdint>
#include <optional>

#include "core/base/bytes.h"

namespace coppice::gltf {

enum class DracoMethod { sequential, edgebreaker };

struct DracoSizes {
    DracoMethod method = DracoMethod::sequential;
    uint32_t triangles = 0;
    uint32_t vertices = 0;       // attributes with seams may still split them
    uint8_t attribute_data = 0;  // edgebreaker: tables of attributes that have seams of their own
};

// Of a stream of triangles; none for anything else. The decoder allocates for so many before it finds out
// whether they are there.
std::optional<DracoSizes> draco_sizes(ByteView stream);

}  // namespace coppice::gltf
