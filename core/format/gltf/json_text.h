// JSON text to a tree, with a bound on its size and depth and no duplicate keys.
#pragma once

#include <nlohmann/json.hpp>
#include <string>

#include "core/base/bytes.h"
#include "core/base/watch.h"
#include "core/format/limits.h"

namespace coppice::gltf {

using Json = nlohmann::json;

// Throws asset_malformed with line and column, asset_too_large.
Json parse_json(ByteView text, const ReadLimits& limits, const Watch& watch);

// No spaces; keys sorted, so equal trees give equal text. Invalid UTF-8 cannot occur in what parse_json made.
std::string print_json(const Json& json, const Watch& watch = {});

}  // namespace coppice::gltf
