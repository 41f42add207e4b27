#include "core/format/gltf/data_uri.h"

#include <openssl/evp.h>

#include <algorithm>

#include "core/base/ascii.h"
#include "core/base/error.h"
#include "core/format/resources.h"

namespace coppice::gltf {

namespace {

Bytes decode_base64(std::string_view text, const std::string& where) {
    require(text.size() % 4 == 0 && text.size() <= (1U << 30), ErrorCode::asset_malformed, where,
            "{} is a data URI whose base64 has {} characters; it must be a multiple of 4", where,
            text.size());
    const size_t padding = text.ends_with("==") ? 2 : text.ends_with('=') ? 1 : 0;
    Bytes bytes(text.size() / 4 * 3);
    const int size = text.empty() ? 0
                                  : EVP_DecodeBlock(reinterpret_cast<unsigned char*>(bytes.data()),
                                                    reinterpret_cast<const unsigned char*>(text.data()),
                                                    static_cast<int>(text.size()));
    // EVP trims white space at both ends: then the size is not what the length of the text says.
    require(size >= 0 && static_cast<size_t>(size) == bytes.size(), ErrorCode::asset_malformed, where,
            "{} is a data URI whose base64 cannot be decoded", where);
    bytes.resize(bytes.size() - padding);
    return bytes;
}

// type/subtype, then ;name=value as often as wanted.
void check_media_type(std::string_view header, const std::string& where) {
    const std::string_view type = header.substr(0, header.find(';'));
    require(type.empty() ||
                (std::count(type.begin(), type.end(), '/') == 1 && type.front() != '/' && type.back() != '/'),
            ErrorCode::asset_malformed, where,
            "{} is a data URI with the media type '{}'; it must be type/subtype", where, type.substr(0, 60));
    while (header.size() > header.find(';')) {
        header = header.substr(header.find(';') + 1);
        const std::string_view parameter = header.substr(0, header.find(';'));
        require(parameter.find('=') != std::string_view::npos && parameter.front() != '=',
                ErrorCode::asset_malformed, where,
                "{} is a data URI with the parameter '{}'; it must be name=value", where,
                parameter.substr(0, 60));
    }
}

}  // namespace

std::optional<DataUri> parse_data_uri(std::string_view uri, const std::string& where) {
    if (!equal_ignoring_case(uri.substr(0, 5), "data:")) return std::nullopt;
    const size_t comma = uri.find(',');
    require(comma != std::string_view::npos, ErrorCode::asset_malformed, where,
            "{} is a data URI without a comma", where);
    std::string_view header = uri.substr(5, comma - 5);
    const bool is_base64 = header.ends_with(";base64");
    if (is_base64) header.remove_suffix(7);
    check_media_type(header, where);
    DataUri result;
    result.media_type = lower(header.substr(0, header.find(';')));
    const std::string_view data = uri.substr(comma + 1);
    result.bytes = is_base64 ? decode_base64(data, where) : to_bytes(percent_decoded(data, where));
    return result;
}

}  // namespace coppice::gltf
