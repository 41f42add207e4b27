#include "core/format/resources.h"

#include <algorithm>

#include "core/base/error.h"

namespace coppice {

namespace {

constexpr size_t most_files_listed = 8;

std::string_view base_name(std::string_view path) {
    return path.substr(path.rfind('/') + 1);
}

// -1 when it is none.
int hex_digit(char c) {
    if (c >= '0' && c <= '9') return c - '0';
    if (c >= 'a' && c <= 'f') return c - 'a' + 10;
    if (c >= 'A' && c <= 'F') return c - 'A' + 10;
    return -1;
}

// "a/./b//c" -> "a/b/c".
std::string tidy(std::string_view path) {
    std::string out;
    while (!path.empty()) {
        const size_t slash = path.find('/');
        const std::string_view step = path.substr(0, slash);
        if (!step.empty() && step != ".") {
            if (!out.empty()) out += '/';
            out += step;
        }
        path = slash == std::string_view::npos ? std::string_view() : path.substr(slash + 1);
    }
    return out;
}

// "http:", "c:", "sha256:"; a colon after the first slash or after other characters is part of a name.
bool has_scheme(std::string_view path) {
    const size_t colon = path.find(':');
    if (colon == std::string_view::npos || colon == 0) return false;
    return std::all_of(path.begin(), path.begin() + static_cast<std::ptrdiff_t>(colon), [](char c) {
        return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '+' ||
               c == '-' || c == '.';
    });
}

bool climbs(std::string_view path) {
    for (size_t begin = 0; begin <= path.size();) {
        const size_t end = std::min(path.find('/', begin), path.size());
        if (path.substr(begin, end - begin) == "..") return true;
        begin = end + 1;
    }
    return false;
}

}  // namespace

std::string percent_decoded(std::string_view uri, std::string_view where) {
    std::string out;
    out.reserve(uri.size());
    for (size_t i = 0; i < uri.size(); ++i) {
        if (uri[i] != '%') {
            out += uri[i];
            continue;
        }
        const int high = i + 1 < uri.size() ? hex_digit(uri[i + 1]) : -1;
        const int low = i + 2 < uri.size() ? hex_digit(uri[i + 2]) : -1;
        require(high >= 0 && low >= 0, ErrorCode::resource_forbidden, where,
                "URI \"{}\" has a '%' at {} that two hexadecimal digits do not follow", uri, i);
        out += static_cast<char>(high * 16 + low);
        i += 2;
    }
    return out;
}

void require_inside_upload(std::string_view path, std::string_view where) {
    constexpr auto code = ErrorCode::resource_forbidden;
    constexpr std::string_view rule = "only relative paths inside the upload are read";
    require(!path.empty(), code, where, "an empty URI names no file; {}", rule);
    require(path.find('\0') == std::string_view::npos, code, where, "URI holds a NUL character; {}", rule);
    require(path.front() != '/', code, where, "URI \"{}\" is absolute; {}", path, rule);
    require(path.find('\\') == std::string_view::npos, code, where, "URI \"{}\" holds a backslash; {}", path,
            rule);
    require(!has_scheme(path), code, where, "URI \"{}\" has a scheme; {}", path, rule);
    require(!climbs(path), code, where, "URI \"{}\" climbs out with \"..\"; {}", path, rule);
}

Resources::Resources(std::vector<ResourceFile> files, std::string folder, FileSource* beside)
    : files_(std::move(files)), found_(files_.size(), false), folder_(std::move(folder)), beside_(beside) {
    for (ResourceFile& file : files_) file.path = tidy(file.path);
}

ByteView Resources::find(std::string_view uri, std::string_view where) const {
    const std::string path = percent_decoded(uri, where);
    const ResourceFile* file = find_path(path, where);
    if (!file) {
        fail(ErrorCode::resource_missing, std::string(where),
             fmt::format("\"{}\" is not in the upload{}", path, listing()));
    }
    return file->bytes;
}

const ResourceFile* Resources::find_path(std::string_view path, std::string_view where) const {
    require_inside_upload(path, where);
    const std::string from_root = tidy(path);
    const std::string wanted = folder_.empty() ? from_root : folder_ + "/" + from_root;
    if (const ResourceFile* own = find_own(wanted, from_root)) {
        found_[static_cast<size_t>(own - files_.data())] = true;
        return own;
    }
    return beside_ != nullptr ? beside_->open(wanted) : nullptr;
}

const ResourceFile* Resources::find_own(const std::string& wanted, const std::string& from_root) const {
    const ResourceFile* exact_from_root = nullptr;
    const ResourceFile* by_base_name = nullptr;
    size_t matches = 0;
    for (const ResourceFile& file : files_) {
        if (file.path == wanted) return &file;
        if (file.path == from_root) exact_from_root = &file;
        if (base_name(file.path) == base_name(wanted)) {
            by_base_name = &file;
            ++matches;
        }
    }
    if (exact_from_root) return exact_from_root;
    return matches == 1 ? by_base_name : nullptr;
}

std::string Resources::listing() const {
    if (files_.empty())
        return "; the upload has no other files: send them as parts named \"resource\", or a zip";
    std::string out = "; the upload has ";
    for (size_t i = 0; i < std::min(files_.size(), most_files_listed); ++i) {
        if (i > 0) out += ", ";
        out += files_[i].path;
    }
    if (files_.size() > most_files_listed)
        out += fmt::format(" and {} more", files_.size() - most_files_listed);
    return out;
}

std::string_view image_mime_type(ByteView bytes) {
    using namespace std::string_view_literals;
    const std::string_view text = as_text(bytes);
    if (text.starts_with("\x89PNG\r\n\x1a\n"sv)) return "image/png";
    if (text.starts_with("\xff\xd8\xff"sv)) return "image/jpeg";
    if (text.starts_with("RIFF"sv) && text.substr(0, 12).substr(8) == "WEBP"sv) return "image/webp";
    if (text.starts_with("\xabKTX 20\xbb"sv)) return "image/ktx2";
    if (text.starts_with("GIF8"sv)) return "image/gif";
    if (text.starts_with("BM"sv)) return "image/bmp";
    if (text.starts_with("DDS "sv)) return "image/vnd-ms.dds";
    return "";
}

}  // namespace coppice
