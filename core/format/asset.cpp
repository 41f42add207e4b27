#include "core/format/asset.h"

#include <algorithm>
#include <utility>

#include "core/base/error.h"
#include "core/format/archive.h"
#include "core/format/clean_triangles.h"
#include "core/format/detect.h"
#include "core/format/gltf/gltf.h"
#include "core/format/obj/read_obj.h"
#include "core/format/obj/write_obj.h"
#include "core/format/ply/read_ply.h"
#include "core/format/resources.h"
#include "core/format/stl/read_stl.h"
#include "core/format/warning_tally.h"

namespace coppice {

namespace {

constexpr size_t most_entries_listed = 10;

size_t depth(std::string_view path) {
    return static_cast<size_t>(std::count(path.begin(), path.end(), '/'));
}

std::string folder(std::string_view path) {
    const size_t slash = path.rfind('/');
    return std::string(path.substr(0, slash == path.npos ? 0 : slash));
}

std::string listing(const std::vector<std::string>& paths) {
    std::string out;
    for (size_t i = 0; i < std::min(paths.size(), most_entries_listed); ++i) {
        out += fmt::format("{}\"{}\"", i > 0 ? ", " : "", paths[i]);
    }
    if (paths.size() > most_entries_listed)
        out += fmt::format(" and {} more", paths.size() - most_entries_listed);
    return out;
}

// By name, as a zip of textures and readmes has many files that only their content would rule out.
std::vector<const NamedFile*> assets_nearest_the_root(const std::vector<NamedFile>& files) {
    std::vector<const NamedFile*> nearest;
    for (const NamedFile& file : files) {
        if (!format_from_file_name(file.path)) continue;
        if (!nearest.empty() && depth(file.path) > depth(nearest.front()->path)) continue;
        if (!nearest.empty() && depth(file.path) < depth(nearest.front()->path)) nearest.clear();
        nearest.push_back(&file);
    }
    return nearest;
}

std::vector<std::string> paths_of(const std::vector<NamedFile>& files) {
    std::vector<std::string> paths;
    for (const NamedFile& file : files) paths.push_back(file.path);
    return paths;
}

const NamedFile& choose_asset(const std::vector<NamedFile>& files, const std::string& entry) {
    if (!entry.empty()) {
        const auto at =
            std::find_if(files.begin(), files.end(), [&](const NamedFile& f) { return f.path == entry; });
        require(at != files.end(), ErrorCode::option_invalid, "entry",
                "entry \"{}\" is not in the zip; it has {}", entry, listing(paths_of(files)));
        return *at;
    }
    const auto assets = assets_nearest_the_root(files);
    require(!assets.empty(), ErrorCode::asset_unsupported, "",
            "no file of the zip is named .glb, .gltf, .obj, .iobj, .ply or .stl; it has {}",
            files.empty() ? "no files" : listing(paths_of(files)));
    std::vector<std::string> names;
    for (const NamedFile* asset : assets) names.push_back(asset->path);
    require(assets.size() == 1, ErrorCode::asset_ambiguous, "entry",
            "the zip has {} assets: choose one with entry={}", assets.size(), listing(names));
    return *assets.front();
}

Scene read_scene(const UploadedFile& file, Format format, const Resources& resources,
                 const ReadLimits& limits, const Watch& watch) {
    switch (format) {
        case Format::obj:
        case Format::iobj:
            return read_obj(file.bytes, resources, limits, watch);
        case Format::ply:
            return read_ply(file.bytes, file.path, resources, limits, watch);
        case Format::stl:
            return read_stl(file.bytes, file.path, limits, watch);
        case Format::glb:
        case Format::gltf:
            return read_gltf(file.bytes, resources, limits, watch);
    }
    fail(ErrorCode::asset_unsupported, "", fmt::format("{} is not read", id(format)));
}

// The client's parts come first among the resources; what else a zip holds needs no use.
void warn_of_unused(const Resources& resources, size_t parts, std::vector<Warning>& warnings) {
    WarningTally tally;
    for (size_t i = 0; i < parts; ++i) {
        if (resources.was_found(i)) continue;
        const std::string& path = resources.files()[i].path;
        tally.note("resource.unused",
                   fmt::format("the resource \"{}\" was sent, but the asset does not use it", path), path);
    }
    tally.move_to(warnings);
}

ReadAsset read_file(const UploadedFile& file, Format format, const Resources& resources, size_t parts,
                    const ReadLimits& limits, const Watch& watch) {
    ReadAsset asset = {read_scene(file, format, resources, limits, watch), format};
    warn_of_unused(resources, parts, asset.scene.warnings);
    // The glTF reader has done so, and its warnings point into the document.
    if (format != Format::glb && format != Format::gltf) clean_triangles(asset.scene, watch);
    return asset;
}

// A client's own path may be absolute or a Windows one; it is only a name to be found under.
std::string tidy_client_path(std::string_view path) {
    std::string out(path);
    std::replace(out.begin(), out.end(), '\\', '/');
    return out.substr(std::min(out.find_first_not_of('/'), out.size()));
}

std::vector<ResourceFile> files_beside(const Upload& upload) {
    std::vector<ResourceFile> files;
    for (const UploadedFile& file : upload.resources)
        files.push_back({tidy_client_path(file.path), file.bytes});
    return files;
}

ReadAsset read_archive(const Upload& upload, const std::string& media_type, const ReadLimits& limits,
                       const Watch& watch) {
    const std::vector<NamedFile> files = read_zip(upload.asset.bytes, limits, watch.part(0, 0.2));
    const NamedFile& asset = choose_asset(files, upload.entry);
    const Format format = detect(asset.bytes, media_type, asset.path);
    std::vector<ResourceFile> resources = files_beside(upload);
    for (const NamedFile& file : files) {
        if (&file != &asset) resources.push_back({file.path, file.bytes});
    }
    return read_file({asset.path, {}, asset.bytes}, format,
                     Resources(std::move(resources), folder(asset.path)), upload.resources.size(), limits,
                     watch.part(0.2, 1));
}

void require_instancing_fits(const WriteOptions& options) {
    const Instancing wanted = options.instancing;
    const bool fits =
        options.format == Format::obj    ? wanted == Instancing::automatic || wanted == Instancing::expand
        : options.format == Format::iobj ? wanted == Instancing::automatic || wanted == Instancing::nodes
                                         : true;
    require(fits, ErrorCode::option_conflict, "instancing", "format={} takes instancing=auto or {}",
            id(options.format), options.format == Format::obj ? "expand" : "nodes");
}

// Files that belong together leave as a zip, one alone as it is.
WrittenAsset packed(ObjFiles written, const WriteOptions& options, const Watch& watch) {
    WrittenAsset out;
    out.mesh_bytes = std::move(written.mesh_bytes);
    out.warnings = std::move(written.warnings);
    const bool alone = written.files.size() == 1;
    out.bytes = alone ? std::move(written.files.front().bytes) : write_zip(written.files, watch);
    out.media_type = alone ? media_type(options.format) : "application/zip";
    out.file_extension = alone ? id(options.format) : "zip";
    return out;
}

// glTF's JSON goes with a buffer, and often with images.
WrittenAsset zipped(GltfFiles written, const Watch& watch) {
    return {write_zip(written.files, watch), "application/zip", "zip", std::move(written.mesh_bytes),
            std::move(written.warnings)};
}

}  // namespace

WrittenAsset write_asset(const Scene& scene, const WriteOptions& options, const Watch& watch) {
    require(is_writable(options.format), ErrorCode::option_invalid, "format",
            "format={} is not written; glb, gltf, obj and iobj are", id(options.format));
    require_instancing_fits(options);
    switch (options.format) {
        case Format::obj:
            return packed(write_obj(scene, options, watch), options, watch);
        case Format::iobj:
            return packed(write_iobj(scene, options, watch), options, watch);
        case Format::glb:
            return write_glb(scene, options, watch);
        case Format::gltf:
            return zipped(write_gltf(scene, options, watch), watch);
        case Format::ply:
        case Format::stl:
            break;
    }
    fail(ErrorCode::option_invalid, "format", fmt::format("format={} is not written", id(options.format)));
}

ReadAsset read_asset(const Upload& upload, const ReadLimits& limits, const Watch& watch) {
    const std::string media_type = told_media_type(upload.asset.media_type);
    if (recognise(upload.asset.bytes).is_zip) return read_archive(upload, media_type, limits, watch);
    require(!is_zip_media_type(media_type) || upload.asset.bytes.empty(), ErrorCode::asset_format_mismatch,
            "", "the media type is {}, but the content is no zip", media_type);
    require(upload.entry.empty(), ErrorCode::option_invalid, "entry",
            "entry=\"{}\" takes a zip, and this is none", upload.entry);
    const std::string path = tidy_client_path(upload.asset.path);
    const Format format = detect(upload.asset.bytes, media_type, path);
    const Resources resources(files_beside(upload), folder(path), upload.beside);
    return read_file({path, {}, upload.asset.bytes}, format, resources, upload.resources.size(), limits,
                     watch);
}

}  // namespace coppice
