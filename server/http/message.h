// A request and its answer, as handlers see them. No library behind.
#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "core/base/bytes.h"
#include "server/http/content.h"

namespace coppice {

// Header fields in the order they came; names in lower case.
class Headers {
  public:
    void add(std::string_view name, std::string value);
    // The first value; none when there is no such field. Names in lower case.
    std::optional<std::string_view> find(std::string_view name) const;
    // All values of one name, joined with ", ".
    std::string joined(std::string_view name) const;
    size_t count(std::string_view name) const;
    const std::vector<std::pair<std::string, std::string>>& all() const { return fields_; }

  private:
    std::vector<std::pair<std::string, std::string>> fields_;
};

// The body of a request, read as it comes; nothing is held whole. One reader at a time.
class Body {
  public:
    Body() = default;
    virtual ~Body() = default;
    Body(const Body&) = delete;
    Body& operator=(const Body&) = delete;

    // How many bytes were put into `into`; 0 at the end only. Throws request_malformed (bad framing, cut
    // off), request_too_large, request_timeout.
    virtual size_t read(std::span<std::byte> into) = 0;
};

struct Request {
    std::string id;      // ours, or the client's X-Request-Id where that is a plain token
    std::string method;  // GET, HEAD, POST, ...
    std::string path;    // percent-decoded, never empty
    std::vector<std::pair<std::string, std::string>> query = {};  // decoded, in order
    std::map<std::string, std::string, std::less<>> path_parameters = {};
    Headers headers = {};
    std::string remote_address = {};
    Body* body = nullptr;                       // never null in a handler
    std::function<bool()> client_is_gone = {};  // asks the socket; for handlers that wait

    const std::string& path_parameter(std::string_view name) const;  // one of the route's own
};

struct Response {
    int status = 200;
    std::vector<std::pair<std::string, std::string>> headers = {};
    std::string content_type = {};
    std::string body = {};                // either this
    std::optional<Content> content = {};  // or this
    std::string job = {};                 // for the log: the job that the exchange was about
    std::string fault = {};               // for the log: what failed on our side

    bool has(std::string_view name) const;          // a header of this name, spelled like this
    void set(std::string name, std::string value);  // replaces what was there under this name
    void json(int with_status, std::string text);
};

}  // namespace coppice
