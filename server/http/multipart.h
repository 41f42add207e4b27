// multipart/form-data (RFC 7578), part by part out of a body that is never held whole.
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "server/http/limits.h"
#include "server/http/message.h"

namespace coppice {

// A media type without its parameters, in lower case; and one of its parameters.
std::string media_type_of(std::string_view content_type);
std::optional<std::string> header_parameter(std::string_view header, std::string_view name);

struct Part {
    std::string name;
    std::string file_name;   // empty when the part has none
    std::string media_type;  // empty when not given
};

class MultipartReader {
  public:
    // Throws request_malformed when the content type has no usable boundary. Body and limits have to outlive
    // it.
    MultipartReader(Body& body, std::string_view content_type, const HttpLimits& limits);

    // Skips what is left of the part before. None: that was the last one, and the body was read to its end.
    std::optional<Part> next();

    // Bytes of the current part; 0 at its end.
    size_t read(std::span<std::byte> into);

  private:
    bool fill();                     // more bytes into the buffer; false at the body's end
    size_t data_before_delimiter();  // bytes of the buffer that surely belong to the part; 0: it ended
    void skip_preamble();
    void skip_part();
    bool delimiter_ends_the_body();  // consumes the delimiter and what follows it on its line
    std::string read_part_header();
    std::string_view buffered() const;
    void require_more(bool more) const;

    Body& body_;
    const HttpLimits& limits_;
    std::string delimiter_;  // CR LF -- boundary
    std::vector<std::byte> buffer_;
    size_t begin_ = 0;
    size_t parts_ = 0;
    bool in_part_ = false;
    bool finished_ = false;
};

}  // namespace coppice
