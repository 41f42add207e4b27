// The head of a request, checked strictly: whatever two parties could read in two ways is refused, so that no
// bytes can be smuggled past a proxy (RFC 9112, section 11.2).
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "server/http/limits.h"
#include "server/http/message.h"

namespace coppice {

struct Head {
    std::string method;
    std::string target;  // as it came: path and query
    std::string path;    // percent-decoded
    std::vector<std::pair<std::string, std::string>> query;
    Headers headers;
    bool chunked = false;
    uint64_t content_length = 0;  // of a body that is not chunked; 0: none
    bool keep_alive = true;
    bool expects_continue = false;

    bool has_body() const { return chunked || content_length > 0; }
};

// `bytes` is everything up to and including the empty line. Throws request_malformed, request_uri_too_long,
// request_encoding_unsupported. After an error the framing is lost, and the connection has to be closed.
Head parse_head(std::string_view bytes, const HttpLimits& limits);

// Decodes %XX ('+' is a space where plus_is_space). Throws request_malformed on anything that is not two hex
// digits, and on a NUL.
std::string percent_decode(std::string_view text, bool plus_is_space);

}  // namespace coppice
