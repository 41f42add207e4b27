// "data:" URIs of buffers and images.
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "core/base/bytes.h"

namespace coppice::gltf {

struct DataUri {
    std::string media_type;  // lower case, without parameters; may be empty
    Bytes bytes;
};

// None when the URI has another scheme. Throws asset_malformed naming where.
std::optional<DataUri> parse_data_uri(std::string_view uri, const std::string& where);

}  // namespace coppice::gltf
