#include "core/format/format.h"

#include <algorithm>
#include <array>

#include "core/base/ascii.h"

namespace coppice {

namespace {

struct FormatRow {
    Format format;
    std::string_view id;
    std::string_view media_type;
    std::string_view other_media_type;  // what others send for it; empty: none
    bool writable;
};

constexpr std::array rows = {
    FormatRow{Format::glb, "glb", "model/gltf-binary", "", true},
    FormatRow{Format::gltf, "gltf", "model/gltf+json", "application/json", true},
    FormatRow{Format::obj, "obj", "model/obj", "application/x-tgif", true},
    FormatRow{Format::iobj, "iobj", "model/vnd.coppice.iobj", "", true},
    FormatRow{Format::ply, "ply", "model/ply", "application/ply", false},
    FormatRow{Format::stl, "stl", "model/stl", "application/sla", false},
};

const FormatRow& row(Format format) {
    return *std::find_if(rows.begin(), rows.end(), [&](const FormatRow& r) { return r.format == format; });
}

}  // namespace

std::string_view id(Format format) {
    return row(format).id;
}
std::string_view media_type(Format format) {
    return row(format).media_type;
}
bool is_writable(Format format) {
    return row(format).writable;
}

std::optional<Format> format_from_id(std::string_view id) {
    for (const FormatRow& r : rows) {
        if (r.id == id) return r.format;
    }
    return std::nullopt;
}

std::optional<Format> format_from_media_type(std::string_view media_type) {
    std::string_view type = media_type.substr(0, media_type.find(';'));
    while (!type.empty() && type.back() == ' ') type.remove_suffix(1);
    const std::string wanted = lower(type);
    for (const FormatRow& r : rows) {
        if (!wanted.empty() && (r.media_type == wanted || r.other_media_type == wanted)) return r.format;
    }
    return std::nullopt;
}

std::optional<Format> format_from_file_name(std::string_view file_name) {
    const size_t dot = file_name.rfind('.');
    if (dot == std::string_view::npos) return std::nullopt;
    return format_from_id(lower(file_name.substr(dot + 1)));
}

}  // namespace coppice
