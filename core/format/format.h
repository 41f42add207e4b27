// The formats, by name.
#pragma once

#include <optional>
#include <string_view>

namespace coppice {

enum class Format { glb, gltf, obj, iobj, ply, stl };

std::string_view id(Format format);          // "glb"
std::string_view media_type(Format format);  // "model/gltf-binary"
bool is_writable(Format format);             // glb, gltf, obj, iobj
std::optional<Format> format_from_id(std::string_view id);
std::optional<Format> format_from_media_type(
    std::string_view media_type);                                         // parameters after ';' are ignored
std::optional<Format> format_from_file_name(std::string_view file_name);  // by extension, any case

}  // namespace coppice
