// The options of one optimization, parsed and typed. Text and JSON become these in proto/.
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>

#include "core/format/asset.h"
#include "core/simplify/parameter.h"

namespace coppice {

struct OptimizeOptions {
    std::string algorithm = {};              // empty: the default algorithm
    std::optional<double> ratio = {};        // of each unique mesh's triangles to keep, 0 < r <= 1
    std::optional<uint64_t> triangles = {};  // over the scene's unique meshes, split in proportion
    std::optional<double> error = {};        // fraction of the scene's bounding-box diagonal
    std::map<std::string, ParameterValue> parameters = {};  // as given; checked against the algorithm's own
    std::optional<Format> format = {};                      // empty: glb; iobj for OBJ input
    Instancing instancing = Instancing::automatic;
    std::string entry = {};           // which file of a zip is the asset, when it holds several
    std::string base_name = "scene";  // of the files in a zip that is written; not on the wire
    unsigned threads = 0;             // 0: one per core; never changes the result
};

// Throws option_invalid, option_unknown or option_conflict. Called before the asset is read, so that a bad
// option fails at once.
void validate(const OptimizeOptions& options);

}  // namespace coppice
