#include "server/http/head.h"

#include <algorithm>
#include <array>

#include "core/base/ascii.h"
#include "core/base/error.h"
#include "core/base/number.h"

namespace coppice {
namespace {

constexpr auto malformed = ErrorCode::request_malformed;

bool is_token(std::string_view text) {
    constexpr std::string_view others = "!#$%&'*+-.^_`|~";
    return !text.empty() && std::all_of(text.begin(), text.end(), [&](char c) {
        return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') ||
               others.find(c) != std::string_view::npos;
    });
}

bool has_control_characters(std::string_view text) {
    return std::any_of(text.begin(), text.end(), [](char c) {
        const auto byte = static_cast<unsigned char>(c);
        return (byte < 0x20 && c != '\t') || byte == 0x7f;
    });
}

// Lines end with CRLF and nothing else: a bare CR or LF is where two parsers differ.
std::vector<std::string_view> split_lines(std::string_view bytes, const HttpLimits& limits) {
    std::vector<std::string_view> lines;
    while (!bytes.empty()) {
        const auto end = bytes.find("\r\n");
        require(end != std::string_view::npos, malformed, "headers", "a header line does not end with CR LF");
        const auto line = bytes.substr(0, end);
        require(line.find_first_of("\r\n") == std::string_view::npos, malformed, "headers",
                "a header line holds a bare CR or LF");
        if (lines.empty()) {
            require(line.size() <= limits.line_bytes, ErrorCode::request_uri_too_long, "",
                    "the request line has {} bytes, the limit is {} (http_line_bytes)", line.size(),
                    limits.line_bytes);
        } else {
            require(line.size() <= limits.line_bytes, malformed, "headers",
                    "a header line has {} bytes, the limit is {} (http_line_bytes)", line.size(),
                    limits.line_bytes);
        }
        lines.push_back(line);
        bytes.remove_prefix(end + 2);
    }
    return lines;
}

// "http://host/path", as it is sent to proxies, is taken too (RFC 9112, section 3.2.2); the host tells us
// nothing.
std::string_view origin_form(std::string_view target) {
    constexpr std::string_view scheme = "http://";
    if (!equal_ignoring_case(target.substr(0, scheme.size()), scheme)) return target;
    target.remove_prefix(scheme.size());
    const auto path = target.find_first_of("/?");
    return path == std::string_view::npos ? "/" : target.substr(path);
}

void parse_target(Head& head) {
    const std::string_view target = origin_form(head.target);
    require(target.starts_with('/'), malformed, "", "the request target must begin with '/'");
    const auto question = target.find('?');
    head.path = percent_decode(target.substr(0, question), false);
    if (question == std::string_view::npos) return;
    std::string_view rest = target.substr(question + 1);
    while (!rest.empty()) {
        const auto pair = rest.substr(0, rest.find('&'));
        rest.remove_prefix(std::min(pair.size() + 1, rest.size()));
        if (pair.empty()) continue;
        const auto equals = pair.find('=');
        const auto value = equals == std::string_view::npos ? std::string_view() : pair.substr(equals + 1);
        head.query.emplace_back(percent_decode(pair.substr(0, equals), true), percent_decode(value, true));
    }
}

bool parse_request_line(std::string_view line, Head& head) {
    const auto first = line.find(' ');
    const auto last = line.rfind(' ');
    require(first != std::string_view::npos && last != first, malformed, "",
            "the request line must be a method, a target and a version");
    head.method = line.substr(0, first);
    head.target = line.substr(first + 1, last - first - 1);
    const auto version = line.substr(last + 1);
    require(is_token(head.method) && head.method.size() <= 32, malformed, "",
            "the request method is not a token");
    require(version == "HTTP/1.1" || version == "HTTP/1.0", malformed, "",
            "the version must be HTTP/1.1 or HTTP/1.0");
    require(head.target.find_first_of(" \t#") == std::string::npos && !has_control_characters(head.target),
            malformed, "", "the request target holds a space, a '#' or a control character");
    parse_target(head);
    return version == "HTTP/1.1";
}

void parse_header(std::string_view line, Head& head) {
    require(line[0] != ' ' && line[0] != '\t', malformed, "headers", "a folded header line is not taken");
    const auto colon = line.find(':');
    require(colon != std::string_view::npos, malformed, "headers", "a header line has no ':'");
    const auto name = line.substr(0, colon);
    require(is_token(name), malformed, "headers", "a header's name is not a token");
    const auto value = trim(line.substr(colon + 1));
    require(!has_control_characters(value), malformed, "headers", "the header {} holds a control character",
            name);
    head.headers.add(name, std::string(value));
}

void parse_framing(Head& head, bool is_http_1_1) {
    const Headers& headers = head.headers;
    const size_t lengths = headers.count("content-length");
    const auto encoding = headers.find("transfer-encoding");
    require(lengths <= 1, malformed, "Content-Length", "the header Content-Length stands {} times", lengths);
    require(!(encoding && lengths > 0), malformed, "Transfer-Encoding",
            "Transfer-Encoding and Content-Length exclude each other");
    if (encoding) {
        require(is_http_1_1, malformed, "Transfer-Encoding", "HTTP/1.0 has no Transfer-Encoding");
        require(headers.count("transfer-encoding") == 1 && equal_ignoring_case(*encoding, "chunked"),
                malformed, "Transfer-Encoding", "the one Transfer-Encoding that is taken is chunked");
        head.chunked = true;
    }
    if (lengths == 1) {
        const auto bytes = parse_whole_number(*headers.find("content-length"));
        require(bytes.has_value(), malformed, "Content-Length", "Content-Length must be a number of bytes");
        head.content_length = *bytes;
    }
}

void parse_connection(Head& head, bool is_http_1_1) {
    head.keep_alive = is_http_1_1;
    const std::string options = head.headers.joined("connection");
    std::string_view rest = options;
    while (!rest.empty()) {
        const auto option = rest.substr(0, rest.find(','));
        rest.remove_prefix(std::min(option.size() + 1, rest.size()));
        if (equal_ignoring_case(trim(option), "close")) head.keep_alive = false;
    }
    if (const auto expect = head.headers.find("expect")) {
        require(equal_ignoring_case(*expect, "100-continue"), malformed, "Expect",
                "the one expectation that is known is 100-continue");
        head.expects_continue = is_http_1_1;
    }
}

}  // namespace

std::string percent_decode(std::string_view text, bool plus_is_space) {
    const auto hex = [](char c) {
        if (c >= '0' && c <= '9') return c - '0';
        if (c >= 'a' && c <= 'f') return c - 'a' + 10;
        if (c >= 'A' && c <= 'F') return c - 'A' + 10;
        return -1;
    };
    std::string decoded;
    decoded.reserve(text.size());
    for (size_t i = 0; i < text.size(); ++i) {
        if (text[i] == '+' && plus_is_space) {
            decoded += ' ';
        } else if (text[i] != '%') {
            decoded += text[i];
        } else {
            const int high = i + 2 < text.size() ? hex(text[i + 1]) : -1;
            const int low = i + 2 < text.size() ? hex(text[i + 2]) : -1;
            require(high >= 0 && low >= 0, malformed, "",
                    "the request target holds a '%' without two hex digits");
            require(high + low > 0, malformed, "", "the request target holds %00");
            decoded += static_cast<char>(high * 16 + low);
            i += 2;
        }
    }
    return decoded;
}

Head parse_head(std::string_view bytes, const HttpLimits& limits) {
    const auto lines = split_lines(bytes, limits);
    require(lines.size() >= 2 && lines.back().empty(), malformed, "headers",
            "the headers do not end with an empty line");
    require(lines.size() - 2 <= limits.headers, malformed, "headers",
            "the request has {} headers, the limit is {} (http_headers)", lines.size() - 2, limits.headers);
    Head head;
    const bool is_http_1_1 = parse_request_line(lines[0], head);
    for (size_t i = 1; i + 1 < lines.size(); ++i) parse_header(lines[i], head);
    require(!is_http_1_1 || head.headers.count("host") == 1, malformed, "Host",
            "HTTP/1.1 needs exactly one Host");
    parse_framing(head, is_http_1_1);
    parse_connection(head, is_http_1_1);
    const auto encoding = head.headers.find("content-encoding");
    require(!encoding || equal_ignoring_case(*encoding, "identity"), ErrorCode::request_encoding_unsupported,
            "Content-Encoding", "the body has Content-Encoding {}; send it as it is", encoding.value_or(""));
    return head;
}

}  // namespace coppice
