#include "core/format/gltf/write_images.h"

#include <algorithm>
#include <map>

#include "core/base/error.h"
#include "core/base/hash.h"

namespace coppice::gltf {

namespace {

// Of a path: everything that RFC 3986 lets stand, and the slashes.
std::string percent_encoded(std::string_view path) {
    std::string out;
    for (const char c : path) {
        const bool is_plain = (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') ||
                              std::string_view("-._~/").find(c) != std::string_view::npos;
        out += is_plain ? std::string(1, c) : fmt::format("%{:02X}", static_cast<unsigned char>(c));
    }
    return out;
}

// "./a//b.png" names the same as "a/b.png".
std::string tidy(std::string_view path) {
    std::string out;
    while (!path.empty()) {
        const size_t slash = std::min(path.find('/'), path.size());
        const std::string_view part = path.substr(0, slash);
        if (!part.empty() && part != ".") out += (out.empty() ? "" : "/") + std::string(part);
        path.remove_prefix(std::min(slash + 1, path.size()));
    }
    return out;
}

}  // namespace

std::vector<NamedFile> write_images(const std::vector<Image>& images, Json& document, BufferWriter& buffer,
                                    bool as_files) {
    std::vector<NamedFile> files;
    std::map<std::string, uint32_t> views;     // by hash
    std::map<std::string, std::string> paths;  // hash by path
    for (size_t i = 0; i < images.size(); ++i) {
        const Image& image = images[i];
        Json& json = document["images"][i];
        const std::string hash = sha256_hex(image.bytes);
        const std::string path = tidy(image.path);
        json.erase("bufferView");
        json.erase("uri");
        const auto known = paths.find(path);
        if (as_files && !path.empty() && (known == paths.end() || known->second == hash)) {
            json["uri"] = percent_encoded(path);
            if (known == paths.end()) files.push_back({path, image.bytes});
            paths.emplace(path, hash);
            continue;
        }
        const auto [view, is_new] = views.try_emplace(hash, 0);
        if (is_new) view->second = buffer.add_view(image.bytes);
        json["bufferView"] = view->second;
        json["mimeType"] = image.mime_type.empty() ? "application/octet-stream" : image.mime_type;
    }
    return files;
}

}  // namespace coppice::gltf
