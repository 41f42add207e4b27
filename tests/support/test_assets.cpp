#include "tests/support/test_assets.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <cstdlib>
#include <fstream>
#include <sstream>
#include <stdexcept>

namespace coppice::test {
namespace {

namespace fs = std::filesystem;

std::string lower(std::string text) {
    std::transform(text.begin(), text.end(), text.begin(),
                   [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
    return text;
}

// Whether the text says "version": "2.0" after "asset": the first place that matters, without parsing JSON
// that may be anything.
bool says_version_2(std::string_view text) {
    const size_t asset = text.find("\"asset\"");
    if (asset == std::string_view::npos) return false;
    const std::string_view object = text.substr(asset, text.find('}', asset) - asset);
    const size_t version = object.find("\"version\"");
    return version != std::string_view::npos && object.find("\"2.0\"", version) != std::string_view::npos;
}

bool is_resource(const fs::path& path) {
    constexpr std::array<std::string_view, 10> extensions = {".bin",  ".mtl",  ".png", ".jpg", ".jpeg",
                                                             ".webp", ".ktx2", ".dds", ".tga", ".gif"};
    const std::string extension = lower(path.extension().string());
    return std::find(extensions.begin(), extensions.end(), extension) != extensions.end();
}

std::string percent_encoded_spaces(const std::string& name) {
    std::string encoded;
    for (const char c : name) encoded += c == ' ' ? std::string("%20") : std::string(1, c);
    return encoded;
}

bool mentions(std::string_view text, const fs::path& path) {
    const std::string name = path.filename().string();
    return text.find(name) != std::string_view::npos ||
           text.find(percent_encoded_spaces(name)) != std::string_view::npos;
}

// The files at or below the asset's folder that its text names, and those that such .mtl files name.
std::vector<fs::path> companions(const fs::path& asset, std::string_view text) {
    std::vector<fs::path> candidates;
    for (const auto& entry : fs::recursive_directory_iterator(asset.parent_path()))
        if (entry.is_regular_file() && is_resource(entry.path())) candidates.push_back(entry.path());
    std::sort(candidates.begin(), candidates.end());

    std::vector<fs::path> found;
    std::string materials;
    for (const auto& path : candidates) {
        if (!mentions(text, path)) continue;
        found.push_back(path);
        if (lower(path.extension().string()) == ".mtl") materials += std::string(as_text(read_file(path)));
    }
    for (const auto& path : candidates)
        if (!materials.empty() && mentions(materials, path) &&
            std::find(found.begin(), found.end(), path) == found.end())
            found.push_back(path);
    return found;
}

}  // namespace

std::optional<fs::path> asset_folder() {
    const char* named = std::getenv("COPPICE_TEST_ASSETS");
    const fs::path folder =
        named != nullptr && *named != '\0' ? fs::path(named) : source_root() / "../shared/assets";
    std::error_code error;
    if (!fs::is_directory(folder, error)) return {};
    return fs::canonical(folder);
}

std::string no_assets_message() {
    return "no test assets: set COPPICE_TEST_ASSETS to their folder (or put them into ../shared/assets "
           "beside the "
           "checkout)";
}

std::vector<std::string> asset_files(std::string_view folder, const std::vector<std::string>& extensions) {
    std::vector<std::string> files;
    const auto root = asset_folder();
    if (!root || !fs::is_directory(*root / folder)) return files;
    for (const auto& entry : fs::recursive_directory_iterator(*root / folder)) {
        if (!entry.is_regular_file()) continue;
        const std::string extension = lower(entry.path().extension().string());
        if (std::find(extensions.begin(), extensions.end(), extension) == extensions.end()) continue;
        files.push_back(fs::relative(entry.path(), *root).generic_string());
    }
    std::sort(files.begin(), files.end());
    return files;
}

std::vector<std::string> gltf2_files(std::string_view folder) {
    std::vector<std::string> files = asset_files(folder, {".glb", ".gltf"});
    const auto root = asset_folder();
    std::erase_if(files,
                  [&](const std::string& file) { return !says_version_2(as_text(read_file(*root / file))); });
    return files;
}

std::map<std::string, std::string> refused_files() {
    std::map<std::string, std::string> refused;
    std::ifstream table(source_root() / "tests/assets/refused_files.tsv");
    std::string line;
    while (std::getline(table, line)) {
        if (line.empty() || line.front() == '#') continue;
        std::istringstream cells(line);
        std::string file;
        std::getline(cells, file, '\t');
        std::getline(cells, refused[file], '\t');
    }
    return refused;
}

std::string test_name(std::string_view file) {
    std::string name(file);
    for (char& c : name)
        if (std::isalnum(static_cast<unsigned char>(c)) == 0) c = '_';
    return name;
}

fs::path source_root() {
    return COPPICE_SOURCE_ROOT;
}

Bytes read_file(const fs::path& path) {
    std::ifstream stream(path, std::ios::binary | std::ios::ate);
    if (!stream) throw std::runtime_error("cannot open " + path.string());
    Bytes bytes(static_cast<size_t>(stream.tellg()));
    stream.seekg(0);
    stream.read(reinterpret_cast<char*>(bytes.data()), static_cast<std::streamsize>(bytes.size()));
    return bytes;
}

UploadedAsset::UploadedAsset(const fs::path& path) {
    bytes_.push_back(std::make_unique<Bytes>(read_file(path)));
    upload_.asset = {.path = path.filename().string(), .bytes = *bytes_.back()};
    for (const auto& companion : companions(path, as_text(upload_.asset.bytes))) {
        bytes_.push_back(std::make_unique<Bytes>(read_file(companion)));
        upload_.resources.push_back(
            {.path = fs::relative(companion, path.parent_path()).generic_string(), .bytes = *bytes_.back()});
    }
}

UploadedAsset load_asset(std::string_view file) {
    return UploadedAsset(*asset_folder() / file);
}

}  // namespace coppice::test
