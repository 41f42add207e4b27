// Which format bytes are in.
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "core/base/bytes.h"
#include "core/format/format.h"

namespace coppice {

// What the content alone tells. At most one is set.
struct Recognised {
    std::optional<Format> format = {};
    bool is_zip = false;
    std::string unsupported = {};  // what it is, where that is known but not read: "FBX (binary)"
};

Recognised recognise(ByteView bytes);

// A media type as the client sent it, without parameters, lower case; empty where it tells nothing
// (octet-stream, x-www-form-urlencoded, text/plain).
std::string told_media_type(std::string_view media_type);

bool is_zip_media_type(std::string_view told);

// The format of a file that is no zip: by content, then media type, then file name. Throws asset_empty,
// asset_format_mismatch where they contradict each other, asset_unsupported for what is not read.
// media_type: as told_media_type gives it, empty or a zip's where there is none for the file itself.
Format detect(ByteView bytes, std::string_view media_type, std::string_view file_name);

}  // namespace coppice
