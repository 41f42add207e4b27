#include "cli/files.h"

#include <unistd.h>

#include <fstream>
#include <system_error>

#include "core/base/error.h"
#include "core/format/archive.h"

namespace coppice {

namespace {

namespace fs = std::filesystem;

std::optional<Bytes> read_file(const fs::path& path) {
    std::error_code error;
    if (!fs::is_regular_file(path, error)) return {};
    std::ifstream file(path, std::ios::binary | std::ios::ate);
    if (!file) return {};
    Bytes bytes(static_cast<size_t>(file.tellg()));
    file.seekg(0);
    file.read(reinterpret_cast<char*>(bytes.data()), static_cast<std::streamsize>(bytes.size()));
    if (!file) return {};
    return bytes;
}

[[noreturn]] void fail_writing(const fs::path& path, const std::string& why) {
    fail(ErrorCode::storage_failed, path.string(),
         fmt::format("{} cannot be written: {}", path.string(), why));
}

bool write_bytes(const fs::path& path, ByteView bytes) {
    std::ofstream file(path, std::ios::binary);
    file.write(reinterpret_cast<const char*>(bytes.data()), static_cast<std::streamsize>(bytes.size()));
    file.close();
    return !file.fail();
}

size_t lay_out(const WrittenAsset& asset, const fs::path& path) {
    const std::vector<NamedFile> files = read_zip(asset.bytes, generous_limits(), {});
    const auto target = [&](const NamedFile& file) {
        const bool is_asset =
            file.path.find('/') == std::string::npos && fs::path(file.path).extension() == path.extension();
        return is_asset ? path : path.parent_path() / file.path;
    };
    for (const NamedFile& file : files) {
        if (target(file) == path) continue;
        const std::optional<Bytes> there = read_file(target(file));
        const bool is_ours = file.path.starts_with(path.stem().string() + ".");  // OUT.bin, OUT.mtl
        if (there && !is_ours && *there != file.bytes) {
            fail_writing(target(file), "another file is there; write into another folder, or to a .zip");
        }
    }
    for (const NamedFile& file : files) {
        std::error_code ignored;  // write_file says what is wrong
        if (!target(file).parent_path().empty()) fs::create_directories(target(file).parent_path(), ignored);
        write_file(target(file), file.bytes);
    }
    return files.size();
}

}  // namespace

AssetFile::AssetFile(const fs::path& path) : path_(path) {
    std::optional<Bytes> bytes = read_file(path);
    require(bytes.has_value(), ErrorCode::request_malformed, "IN", "{} is no file that can be read",
            path.string());
    bytes_ = std::move(*bytes);
}

Upload AssetFile::upload() {
    Upload upload;
    upload.asset = {.path = path_.filename().string(), .bytes = bytes_};
    upload.beside = this;
    return upload;
}

const ResourceFile* AssetFile::open(const std::string& path) {
    if (const auto known = opened_.find(path); known != opened_.end()) return &known->second.file;
    std::optional<Bytes> bytes = read_file(path_.parent_path() / path);
    if (!bytes) return nullptr;
    Opened& opened = opened_[path];
    opened.bytes = std::move(*bytes);
    opened.file = {path, opened.bytes};
    return &opened.file;
}

uint64_t AssetFile::opened_bytes() const {
    uint64_t sum = 0;
    for (const auto& [path, opened] : opened_) sum += opened.bytes.size();
    return sum;
}

ReadLimits generous_limits() {
    constexpr uint64_t many = 4'000'000'000;
    return {.triangles = many / 3,
            .rendered_triangles = 1'000'000'000'000,
            .instances = 100'000'000,
            .vertices = many,
            .json_bytes = many,
            .json_values = many,
            .nodes = 50'000'000,
            .meshes_and_primitives = 10'000'000,
            .accessors = 50'000'000,
            .objects = 50'000'000,
            .attributes = 100'000,
            .attribute_bytes = many,
            .images = 100'000,
            .zip_entries = 1'000'000,
            .zip_bytes = 16 * many,
            .zip_ratio = 2000};
}

std::optional<Format> output_format_of(const fs::path& path) {
    if (path.extension() == ".zip") return {};
    const std::optional<Format> format = format_from_file_name(path.string());
    require(format && is_writable(*format), ErrorCode::option_invalid, "output",
            "the name {} asks for no format that is written; end it with .glb, .gltf, .obj, .iobj or .zip, "
            "or give "
            "--format",
            path.filename().string());
    return format;
}

size_t write_asset_file(const WrittenAsset& asset, const fs::path& path) {
    if (asset.file_extension == "zip" && path.extension() != ".zip") return lay_out(asset, path);
    write_file(path, asset.bytes);
    return 1;
}

void write_file(const fs::path& path, ByteView bytes) {
    std::error_code error;
    // A device or a pipe is written to; only a file is replaced, and a link stays one.
    const bool replaces = fs::is_regular_file(path, error) || !fs::exists(path, error);
    const fs::path target =
        fs::is_symlink(path, error) && replaces ? fs::weakly_canonical(path, error) : path;
    if (!replaces) {
        if (!write_bytes(path, bytes)) fail_writing(path, "it takes no bytes");
        return;
    }
    fs::path partial = target;
    partial += ".partial-" + std::to_string(getpid());
    if (!write_bytes(partial, bytes)) {
        fs::remove(partial, error);
        fail_writing(path, "is its folder there, and is there room?");
    }
    fs::rename(partial, target, error);
    if (!error) return;
    const std::string why = error.message();
    fs::remove(partial, error);
    fail_writing(path, why);
}

}  // namespace coppice
