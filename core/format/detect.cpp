#include "core/format/detect.h"

#include <algorithm>
#include <array>

#include "core/base/ascii.h"
#include "core/base/error.h"
#include "core/base/number.h"
#include "core/format/gltf_version.h"
#include "core/format/iobj/directive.h"
#include "core/format/line_reader.h"
#include "core/format/resources.h"
#include "core/format/stl/read_stl.h"
#include "core/format/utf16.h"

namespace coppice {

namespace {

using namespace std::string_view_literals;

constexpr std::string_view what_is_read =
    "glTF 2.0 (glb, gltf), OBJ (obj, iobj), PLY and STL are read, or a zip of one with its resources";
constexpr size_t sniffed_bytes = 64 << 10;
constexpr size_t sniffed_lines = 400;
constexpr size_t solid_sniffed = 1024;

struct Signature {
    std::string_view begins;
    std::string_view what;
};

constexpr std::array signatures = {
    Signature{"i3dm"sv, "3D Tiles i3dm"},
    Signature{"b3dm"sv, "3D Tiles b3dm"},
    Signature{"pnts"sv, "3D Tiles pnts"},
    Signature{"cmpt"sv, "3D Tiles cmpt"},
    Signature{"Kaydara FBX Binary"sv, "FBX (binary)"},
    Signature{"; FBX"sv, "FBX (text)"},
    Signature{"BLENDER"sv, "a Blender file"},
    Signature{"DRACO"sv, "a bare Draco mesh"},
    Signature{"PXR-USDC"sv, "USD"},
    Signature{"#usda"sv, "USD"},
    Signature{"#VRML"sv, "VRML"},
    Signature{"ISO-10303-21"sv, "STEP"},
    Signature{"xof "sv, "DirectX .x"},
    Signature{"OFF\n"sv, "OFF"},
    Signature{"OFF\r"sv, "OFF"},
    Signature{"OFF "sv, "OFF"},
    Signature{"COFF"sv, "OFF"},
    Signature{"NOFF"sv, "OFF"},
    Signature{"%PDF"sv, "PDF"},
    Signature{"\x1f\x8b"sv, "gzip"},
    Signature{"7z\xbc\xaf\x27\x1c"sv, "a 7z archive"},
    Signature{"Rar!"sv, "a RAR archive"},
    Signature{"\x28\xb5\x2f\xfd"sv, "zstd"},
};

constexpr std::array obj_words = {
    "v"sv,      "vt"sv,     "vn"sv,    "f"sv,        "fo"sv,       "o"sv,         "g"sv,   "s"sv,
    "l"sv,      "p"sv,      "vp"sv,    "vw"sv,       "usemtl"sv,   "mtllib"sv,    "lod"sv, "cstype"sv,
    "usemap"sv, "maplib"sv, "bevel"sv, "c_interp"sv, "d_interp"sv, "shadow_obj"sv};

bool contains(std::string_view text, std::string_view part) {
    return text.find(part) != text.npos;
}

std::string_view without_leading_blanks(std::string_view text) {
    return text.substr(std::min(text.find_first_not_of(" \t\r\n"), text.size()));
}

std::string_view without_byte_order_mark(std::string_view text) {
    return text.starts_with("\xef\xbb\xbf") ? text.substr(3) : text;
}

bool is_number(std::string_view word) {
    return parse_number(word).has_value();
}

// 7, -7, 7/7, 7//7 or 7/7/7
bool is_corner(std::string_view word) {
    return word.find_first_of("0123456789") < 2 && word.find_first_not_of("-/0123456789") == word.npos;
}

// v, vt, vn and f with as many numbers as they take.
bool is_obj_geometry(std::string_view word, Line& line) {
    const bool is_face = word == "f";
    if (!is_face && word != "v" && word != "vt" && word != "vn") return false;
    size_t numbers = 0;
    for (; !line.ended(); ++numbers) {
        const std::string_view next = line.word();
        if (!(is_face ? is_corner(next) : is_number(next))) return false;
    }
    return numbers >= (word == "vt" ? 1U : 3U);
}

// Every line of the beginning is OBJ's, and one of them has geometry or an object. Where a word is not known,
// two lines have to be geometry beyond doubt.
bool looks_like_obj(std::string_view text) {
    bool has_geometry = false, has_other_words = false;
    size_t sure = 0;
    LineReader reader(text, true);
    Line line;
    for (size_t i = 0; i < sniffed_lines && reader.next(line); ++i) {
        if (reader.offset() >= text.size() && text.size() == sniffed_bytes)
            break;  // the cut may be inside the line
        if (line.ended()) continue;
        const std::string_view word = line.word();
        if (std::find(obj_words.begin(), obj_words.end(), word) == obj_words.end()) has_other_words = true;
        has_geometry = has_geometry || word == "v" || word == "f" || word == "o" || word == "g";
        if (is_obj_geometry(word, line)) ++sure;
    }
    return has_other_words ? sure >= 2 : has_geometry;
}

std::string unsupported_text(std::string_view text) {
    if (!text.starts_with('<')) return {};
    if (contains(text, "<COLLADA")) return "COLLADA (dae)";
    if (contains(text, "<X3D")) return "X3D";
    if (contains(text, "<html") || contains(text, "<!DOCTYPE html") || contains(text, "<HTML")) return "HTML";
    if (contains(text, "<svg")) return "SVG";
    return "XML";
}

// Of one that does not begin with "2.".
std::string_view meaning_of_version(std::string_view version) {
    if (version.starts_with("0.") || version.starts_with("1.")) return "glTF 1.0, 3D Tiles";
    const auto number = parse_number(version);
    return number && *number > 2 && *number < 10 ? "later than glTF 2.0" : "no version of glTF";
}

Recognised json(std::string_view text) {
    const std::string version = gltf_version(text);
    if (version.empty()) return {};
    if (version.starts_with("2.")) return {.format = Format::gltf};
    return {.unsupported = fmt::format("JSON with asset.version \"{}\" ({})", version.substr(0, 20),
                                       meaning_of_version(version))};
}

Recognised glb(ByteView bytes) {
    const uint32_t version = bytes.size() >= 8 ? load_u32(bytes, 4) : 2;
    if (version == 1) return {.unsupported = "glTF 1.0 (binary)"};
    return {.format = Format::glb};
}

// 0x4d4d and a chunk size that is the file's.
bool is_3ds(ByteView bytes) {
    return bytes.size() >= 6 && load_u16(bytes, 0) == 0x4d4d && load_u32(bytes, 2) == bytes.size();
}

Recognised recognise_text(std::string_view text) {
    const std::string_view head = text.substr(0, sniffed_bytes);
    const std::string_view begin = without_leading_blanks(without_byte_order_mark(head));
    if (begin.starts_with('{')) return json(text);
    if (is_iobj(head)) return {.format = Format::iobj};
    if (const std::string what = unsupported_text(begin); !what.empty()) return {.unsupported = what};
    const std::string solid = lower(begin.substr(0, solid_sniffed));
    if (solid.starts_with("solid") && (contains(solid, "facet") || contains(solid, "endsolid"))) {
        return {.format = Format::stl};
    }
    if (looks_like_obj(head)) return {.format = Format::obj};
    return {};
}

// Every iobj is an OBJ too; a GLB under the name of a gltf is not.
bool agree(Format content, Format told) {
    return content == told || (content == Format::iobj && told == Format::obj);
}

// For messages: a body that is no file has no name.
std::string place_of(std::string_view file_name) {
    return file_name.empty() ? "asset" : std::string(file_name);
}

Format checked_format(Format content, std::string_view media_type, std::string_view file_name) {
    constexpr auto mismatch = ErrorCode::asset_format_mismatch;
    const std::string where = place_of(file_name);
    if (!media_type.empty() && !is_zip_media_type(media_type)) {
        const std::optional<Format> told = format_from_media_type(media_type);
        require(told && agree(content, *told), mismatch, where,
                "the content is {}, but the media type says \"{}\"; send it as {}, or with no type",
                id(content), media_type, coppice::media_type(content));
    }
    const std::optional<Format> named = format_from_file_name(file_name);
    require(!named || agree(content, *named), mismatch, where,
            "the content is {}, but the file is named \"{}\"; end its name with .{}", id(content), file_name,
            id(content));
    return content;
}

// Text so loose, or so broken, that only its name tells what it was meant to be.
Format told_format(std::string_view media_type, std::string_view file_name) {
    const std::optional<Format> told = format_from_media_type(media_type);
    const std::optional<Format> named = format_from_file_name(file_name);
    require(!told || !named || *told == *named, ErrorCode::asset_format_mismatch, place_of(file_name),
            "the media type says {}, but the file is named \"{}\"; give both the same, or one of them",
            told ? id(*told) : "", file_name);
    if (told) return *told;
    if (named && media_type.empty()) return *named;
    fail(ErrorCode::asset_unsupported, place_of(file_name),
         media_type.empty()
             ? fmt::format("the content is of no format that is recognised; {}. If it is one of these, say "
                           "which, by its Content-Type (model/obj) or the ending of its name",
                           what_is_read)
             : fmt::format("the content is of no format that is read, and neither is \"{}\"; {}", media_type,
                           what_is_read));
}

}  // namespace

Recognised recognise(ByteView bytes) {
    const std::string_view text = as_text(bytes);
    if (text.starts_with("glTF")) return glb(bytes);
    if (text.starts_with("PK\x03\x04"sv) || text.starts_with("PK\x05\x06"sv)) return {.is_zip = true};
    if (text.starts_with("ply\n") || text.starts_with("ply\r")) return {.format = Format::ply};
    if (is_binary_stl(bytes)) return {.format = Format::stl};
    for (const Signature& s : signatures) {
        if (text.starts_with(s.begins)) return {.unsupported = std::string(s.what)};
    }
    if (is_3ds(bytes)) return {.unsupported = "3DS"};
    const std::string_view image = image_mime_type(bytes);
    if (!image.empty()) return {.unsupported = fmt::format("an image ({})", image)};
    if (is_utf16(bytes))
        return recognise_text(utf8_from_utf16(bytes.first(std::min(bytes.size(), sniffed_bytes))));
    return recognise_text(text);
}

std::string told_media_type(std::string_view media_type) {
    std::string type = lower(media_type.substr(0, media_type.find(';')));
    while (!type.empty() && type.back() == ' ') type.pop_back();
    constexpr std::array nothing = {"application/octet-stream"sv, "application/x-www-form-urlencoded"sv,
                                    "text/plain"sv, "binary/octet-stream"sv};
    return std::find(nothing.begin(), nothing.end(), type) == nothing.end() ? type : std::string();
}

bool is_zip_media_type(std::string_view told) {
    return told == "application/zip" || told == "application/x-zip-compressed" || told == "application/x-zip";
}

Format detect(ByteView bytes, std::string_view media_type, std::string_view file_name) {
    require(!bytes.empty(), ErrorCode::asset_empty, "", "the asset is empty; {}", what_is_read);
    const Recognised content = recognise(bytes);
    require(content.unsupported.empty(), ErrorCode::asset_unsupported, place_of(file_name),
            "the content is {}, which is not read; {}", content.unsupported, what_is_read);
    require(!content.is_zip, ErrorCode::asset_unsupported, "",
            "\"{}\" is a zip inside a zip, which is not read", file_name);
    if (content.format) return checked_format(*content.format, media_type, file_name);
    return told_format(media_type, file_name);
}

}  // namespace coppice
