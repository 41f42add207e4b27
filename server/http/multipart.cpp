#include "server/http/multipart.h"

#include <algorithm>
#include <array>

#include "core/base/ascii.h"
#include "core/base/error.h"

namespace coppice {
namespace {

constexpr auto malformed = ErrorCode::request_malformed;
constexpr size_t read_bytes = 64 << 10;

// What stands between quotes, or up to the next ';'. Advances past it.
std::string take_value(std::string_view& rest) {
    std::string value;
    if (rest.empty() || rest[0] != '"') {
        const auto end = std::min(rest.find(';'), rest.size());
        value = trim(rest.substr(0, end));
        rest.remove_prefix(end);
        return value;
    }
    size_t i = 1;
    for (; i < rest.size() && rest[i] != '"'; ++i) {
        // Browsers and curl escape '"' only; a backslash before anything else is part of a name from Windows.
        if (rest[i] == '\\' && i + 1 < rest.size() && (rest[i + 1] == '"' || rest[i + 1] == '\\')) ++i;
        value += rest[i];
    }
    rest.remove_prefix(std::min(i + 1, rest.size()));
    return value;
}

}  // namespace

std::string media_type_of(std::string_view content_type) {
    return lower(trim(content_type.substr(0, content_type.find(';'))));
}

std::optional<std::string> header_parameter(std::string_view header, std::string_view name) {
    auto semicolon = header.find(';');
    while (semicolon != std::string_view::npos) {
        header.remove_prefix(semicolon + 1);
        const auto equals = header.find('=');
        if (equals == std::string_view::npos) return std::nullopt;
        const std::string found = lower(trim(header.substr(0, equals)));
        header.remove_prefix(equals + 1);
        while (!header.empty() && (header[0] == ' ' || header[0] == '\t')) header.remove_prefix(1);
        std::string value = take_value(header);
        if (found == name) return value;
        semicolon = header.find(';');
    }
    return std::nullopt;
}

MultipartReader::MultipartReader(Body& body, std::string_view content_type, const HttpLimits& limits)
    : body_(body), limits_(limits) {
    const auto boundary = header_parameter(content_type, "boundary");
    require(boundary && !boundary->empty() && boundary->size() <= 70, malformed, "Content-Type",
            "multipart/form-data needs a boundary of 1 to 70 characters");
    delimiter_ = "\r\n--" + *boundary;
    append(buffer_, as_bytes("\r\n"));  // so that a boundary at the very beginning is found like all others
}

std::string_view MultipartReader::buffered() const {
    return as_text(ByteView(buffer_).subspan(begin_));
}

bool MultipartReader::fill() {
    buffer_.erase(buffer_.begin(), buffer_.begin() + static_cast<ptrdiff_t>(begin_));
    begin_ = 0;
    const size_t before = buffer_.size();
    buffer_.resize(before + read_bytes);
    const size_t got = body_.read(std::span(buffer_).subspan(before));
    buffer_.resize(before + got);
    return got > 0;
}

void MultipartReader::require_more(bool more) const {
    require(more, malformed, "", "the multipart body ends before its closing boundary");
}

size_t MultipartReader::data_before_delimiter() {
    for (;;) {
        const std::string_view bytes = buffered();
        const auto found = bytes.find(delimiter_);
        if (found != std::string_view::npos) return found;
        // The last bytes may be the beginning of a delimiter that is still to come.
        if (bytes.size() >= delimiter_.size()) return bytes.size() - delimiter_.size() + 1;
        require_more(fill());
    }
}

size_t MultipartReader::read(std::span<std::byte> into) {
    if (!in_part_) return 0;
    const size_t available = data_before_delimiter();
    if (available == 0) {
        in_part_ = false;
        return 0;
    }
    const size_t taken = std::min(available, into.size());
    std::copy_n(buffer_.begin() + static_cast<ptrdiff_t>(begin_), taken, into.begin());
    begin_ += taken;
    return taken;
}

void MultipartReader::skip_part() {
    std::array<std::byte, 4096> skipped{};
    while (read(skipped) > 0) {
    }
}

void MultipartReader::skip_preamble() {
    in_part_ = true;
    skip_part();
}

bool MultipartReader::delimiter_ends_the_body() {
    begin_ += delimiter_.size();
    while (buffered().size() < 2) require_more(fill());
    if (buffered().starts_with("--")) return true;
    for (;;) {  // white space may follow a boundary
        while (buffered().size() < 2) require_more(fill());
        if (buffered().starts_with("\r\n")) break;
        require(buffered()[0] == ' ' || buffered()[0] == '\t', malformed, "",
                "a boundary is followed by something else");
        ++begin_;
    }
    begin_ += 2;
    return false;
}

std::string MultipartReader::read_part_header() {
    for (;;) {
        const std::string_view bytes = buffered();
        if (bytes.starts_with("\r\n")) {
            begin_ += 2;
            return {};
        }
        const auto end = bytes.find("\r\n\r\n");
        const size_t bytes_of_header = end == std::string_view::npos ? bytes.size() : end;
        require(bytes_of_header <= limits_.part_header_bytes, malformed, "",
                "the headers of part {} are longer than {} bytes (http_part_header_bytes)", parts_,
                limits_.part_header_bytes);
        if (end != std::string_view::npos) {
            std::string header(bytes.substr(0, end));
            begin_ += end + 4;
            return header;
        }
        require_more(fill());
    }
}

std::optional<Part> MultipartReader::next() {
    if (finished_) return std::nullopt;
    if (parts_ == 0) {
        skip_preamble();
    } else {
        skip_part();
    }
    if (delimiter_ends_the_body()) {
        begin_ = buffer_.size();
        while (fill()) begin_ = buffer_.size();  // the epilogue
        finished_ = true;
        return std::nullopt;
    }
    ++parts_;
    require(parts_ <= limits_.parts, malformed, "", "the body has more than {} parts (http_parts)",
            limits_.parts);

    const std::string header = read_part_header();
    Part part;
    std::string_view rest = header;
    while (!rest.empty()) {
        const auto line = rest.substr(0, rest.find("\r\n"));
        rest.remove_prefix(std::min(line.size() + 2, rest.size()));
        const auto colon = line.find(':');
        require(colon != std::string_view::npos, malformed, "", "a header of part {} has no ':'", parts_);
        const std::string name = lower(line.substr(0, colon));
        const auto value = trim(line.substr(colon + 1));
        if (name == "content-type") part.media_type = media_type_of(value);
        if (name == "content-disposition") {
            part.name = header_parameter(value, "name").value_or("");
            part.file_name = header_parameter(value, "filename").value_or("");
        }
    }
    require(!part.name.empty(), malformed, "",
            "part {} has no name (Content-Disposition: form-data; name=...)", parts_);
    in_part_ = true;
    return part;
}

}  // namespace coppice
