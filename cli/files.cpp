#include "cli/files.h"

#include <fstream>
#include <system_error>

#include "core/base/error.h"

namespace coppice {

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

}  // namespace coppice
