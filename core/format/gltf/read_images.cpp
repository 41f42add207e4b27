#include "core/format/gltf/read_images.h"

#include "core/format/gltf/checks.h"
#include "core/format/gltf/data_uri.h"
#include "core/format/gltf/image_header.h"

namespace coppice::gltf {

namespace {

Image image_from_uri(const std::string& uri, const Resources& resources, const std::string& where) {
    Image image;
    if (auto data = parse_data_uri(uri, where)) {
        image.bytes = std::move(data->bytes);
        image.mime_type = std::move(data->media_type);
        return image;
    }
    const ByteView bytes = resources.find(uri, where);
    image.bytes.assign(bytes.begin(), bytes.end());
    image.path = percent_decoded(uri, where);
    return image;
}

Image read_image(Parsed& parsed, const Json& json, const Resources& resources, const Pointer& where) {
    const auto view = index_at(json, "bufferView");
    demand(view.has_value() != json.contains("uri"), where, "must have exactly one of uri and bufferView");
    Image image;
    if (view) {
        demand(json.contains("mimeType"), where, "has a bufferView, so it must have a mimeType");
        demand(!parsed.json["bufferViews"][*view].contains("byteStride"), where / "bufferView",
               "is {}, which has a byteStride; only vertex attributes may", *view);
        set_view_usage(parsed, *view, ViewUsage::image, where / "bufferView");
        demand(!parsed.views[*view].empty(), where, "reads buffer view {}, whose buffer has no bytes", *view);
        image.bytes.assign(parsed.views[*view].begin(), parsed.views[*view].end());
    } else {
        image = image_from_uri(text_at(json, "uri"), resources, (where / "uri").text());
    }
    image.name = text_at(json, "name");
    const std::string_view actual = image_mime_type(image.bytes);
    const std::string in_uri = image.mime_type;
    const std::string declared = text_at(json, "mimeType");
    for (const std::string& type : {in_uri, declared})
        demand(type.empty() || actual.empty() || type == actual, where, "is declared to be {}, but is {}",
               type.substr(0, 60), actual);
    image.mime_type = !actual.empty() ? std::string(actual) : !declared.empty() ? declared : in_uri;
    check_image_header(image.bytes, where.text());
    return image;
}

}  // namespace

void read_images(Parsed& parsed, const Resources& resources, const ReadLimits& limits) {
    const Json& images = list(parsed.json, "images");
    uint64_t total = 0;
    for (size_t i = 0; i < images.size(); ++i) {
        parsed.images.push_back(read_image(parsed, images[i], resources, pointer("images", i)));
        // Many images may name the same bytes, and each gets a copy.
        total += parsed.images.back().bytes.size();
        require(total <= limits.zip_bytes, ErrorCode::asset_too_large, pointer("images", i),
                "the images have more than {} bytes (limit zip_bytes)", limits.zip_bytes);
    }
}

}  // namespace coppice::gltf
