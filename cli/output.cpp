#include "cli/output.h"

#include <string_view>
#include <system_error>
#include <vector>

#include "cli/files.h"
#include "cli/write_files.h"
#include "core/base/ascii.h"
#include "core/base/error.h"
#include "core/format/archive.h"

namespace coppice {

namespace {

namespace fs = std::filesystem;

bool is_zip(const fs::path& path) {
    return equal_ignoring_case(path.extension().string(), ".zip");
}

Format format_in_zip(const fs::path& path, std::optional<Format> told) {
    require(
        told != Format::glb, ErrorCode::option_conflict, "format",
        "{} is a zip, which holds gltf, obj or iobj, but --format is glb; end the name with .glb, or give "
        "--format gltf",
        path.filename().string());
    return told.value_or(Format::gltf);
}

bool is_beside(const NamedFile& file, const fs::path& path) {
    return file.path.find('/') != std::string::npos ||
           format_from_file_name(file.path) != format_from_file_name(path.string());
}

// OUT.bin and OUT.mtl are ours to replace; a texture has the name that the asset gave it.
void require_free(const NamedFile& file, const fs::path& place, const std::string& stem) {
    const std::optional<Bytes> there = read_file(place);
    const bool is_ours = file.path == stem + ".bin" || file.path == stem + ".mtl";
    require(!there || is_ours || *there == file.bytes, ErrorCode::storage_failed, place.string(),
            "{} cannot be written: another file is there; write into another folder, or to a .zip",
            place.string());
}

size_t lay_out(const WrittenAsset& asset, const fs::path& path) {
    const std::vector<NamedFile> files = read_zip(asset.bytes, generous_limits(), {});
    std::vector<NewFile> written;
    ByteView of_asset;
    for (const NamedFile& file : files) {
        if (!is_beside(file, path)) {
            of_asset = file.bytes;
            continue;
        }
        const fs::path place = path.parent_path() / file.path;
        require_free(file, place, path.stem().string());
        written.push_back({place, file.bytes});
    }
    written.push_back({path, of_asset});  // last: where it is, all that it names is there
    for (const NewFile& file : written) {
        std::error_code ignored;  // write_files says what is wrong
        const fs::path folder = file.path.parent_path();
        if (file.path != path && folder != path.parent_path()) fs::create_directories(folder, ignored);
    }
    write_files(written);
    return written.size();
}

constexpr std::string_view right_ending = "end the name with .glb, .gltf, .obj, .iobj or .zip";

// What the ending asks for; none where it is no format's.
std::optional<Format> named_format(const fs::path& path) {
    const std::optional<Format> named = format_from_file_name(path.string());
    require(!named || is_writable(*named), ErrorCode::option_invalid, "output",
            "{} asks for {}, which is read and not written; {}", path.filename().string(),
            named ? id(*named) : "", right_ending);
    return named;
}

}  // namespace

Format output_format(const fs::path& path) {
    if (is_zip(path)) return format_in_zip(path, {});
    const std::optional<Format> named = named_format(path);
    require(named.has_value(), ErrorCode::option_invalid, "output",
            "{} does not say in which format to write; {}", path.filename().string(), right_ending);
    return *named;
}

Format output_format(const fs::path& path, std::optional<Format> told) {
    if (is_zip(path)) return format_in_zip(path, told);
    const std::optional<Format> named = named_format(path);
    const std::string name = path.filename().string();
    require(!named || !told || *named == *told, ErrorCode::option_conflict, "format",
            "{} asks for {}, but --format is {}; end the name with .{}, or leave --format out", name,
            named ? id(*named) : "", told ? id(*told) : "", told ? id(*told) : "");
    require(named || told, ErrorCode::option_invalid, "output",
            "{} does not say in which format to write; {}, or give --format", name, right_ending);
    return named ? *named : *told;
}

size_t write_asset_file(const WrittenAsset& asset, const fs::path& path) {
    const bool is_packed = asset.file_extension == "zip";
    if (is_packed && format_from_file_name(path.string())) return lay_out(asset, path);
    if (is_zip(path) && !is_packed) {  // an OBJ without materials
        write_file(path, write_zip({{path.stem().string() + "." + asset.file_extension, asset.bytes}}, {}));
    } else {
        write_file(path, asset.bytes);
    }
    return 1;
}

}  // namespace coppice
