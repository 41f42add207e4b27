#include "server/http/framed_body.h"

#include <algorithm>
#include <array>
#include <charconv>

#include "core/base/error.h"

namespace coppice {
namespace {

constexpr auto malformed = ErrorCode::request_malformed;
constexpr size_t max_chunk_line_bytes = 256;  // the size and its extensions; also each trailer

}  // namespace

FramedBody::FramedBody(Source source, bool chunked, uint64_t content_length, uint64_t limit_bytes)
    : source_(std::move(source)),
      chunked_(chunked),
      left_(chunked ? 0 : content_length),
      limit_bytes_(limit_bytes),
      finished_(!chunked && content_length == 0) {}

size_t FramedBody::read(std::span<std::byte> into) {
    if (finished_ || into.empty()) return 0;
    if (chunked_ && left_ == 0) next_chunk();
    if (finished_) return 0;
    require(left_ <= limit_bytes_ - bytes_read_, ErrorCode::request_too_large, "",
            "the body has more than {} bytes, the limit (upload_bytes)", limit_bytes_);
    const size_t got = read_some(into.first(static_cast<size_t>(std::min<uint64_t>(into.size(), left_))));
    left_ -= got;
    bytes_read_ += got;
    if (!chunked_ && left_ == 0) finished_ = true;
    return got;
}

size_t FramedBody::read_some(std::span<std::byte> into) {
    const size_t got = source_(into);
    require(got > 0, malformed, "", "the connection ended within the body, after {} bytes", bytes_read_);
    return got;
}

// chunk-size [;extensions] CRLF data CRLF ... 0 CRLF trailers CRLF
void FramedBody::next_chunk() {
    if (in_chunk_) require(read_line().empty(), malformed, "", "a chunk is longer than its size says");
    const std::string line = read_line();
    const auto size = std::string_view(line).substr(0, line.find_first_of("; \t"));
    const size_t rest = line.find_first_not_of(" \t", size.size());
    require(rest == std::string::npos || line[rest] == ';', malformed, "",
            "after a chunk's size comes what is no extension");
    const auto [end, error] = std::from_chars(size.data(), size.data() + size.size(), left_, 16);
    require(!size.empty() && size[0] != '-' && error == std::errc() && end == size.data() + size.size(),
            malformed, "", "a chunk's size is not a hexadecimal number");
    in_chunk_ = true;
    if (left_ > 0) return;
    for (int trailers = 0; !read_line().empty(); ++trailers) {
        require(trailers < 16, malformed, "", "the body has more than 16 trailers");
    }
    finished_ = true;
}

std::string FramedBody::read_line() {
    std::string line;
    std::array<std::byte, 1> next{};
    while (!line.ends_with("\r\n")) {
        read_some(next);
        line += static_cast<char>(next[0]);
        require(line.size() <= max_chunk_line_bytes, malformed, "", "a chunk's first line is too long");
        require(line.back() != '\n' || line.ends_with("\r\n"), malformed, "",
                "a chunk's line ends with a bare LF");
    }
    line.resize(line.size() - 2);
    require(std::none_of(line.begin(), line.end(),
                         [](unsigned char c) { return (c < ' ' && c != '\t') || c == 127; }),
            malformed, "", "a chunk's line has a control character");
    return line;
}

}  // namespace coppice
