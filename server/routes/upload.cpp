#include "server/routes/upload.h"

#include <array>
#include <optional>
#include <set>

#include "core/base/error.h"
#include "core/format/detect.h"
#include "proto/options.h"
#include "server/http/multipart.h"

namespace coppice {
namespace {

constexpr size_t read_bytes = 256 << 10;
constexpr size_t max_options_bytes = 64 << 10;

// read: fills a span, 0 at the end.
template <typename Read>
StoredFile store_stream(ReceivedUpload& upload, BlobStore& blobs, const Read& read) {
    auto writer = blobs.create();
    Bytes buffer(read_bytes);
    while (const size_t got = read(std::span(buffer))) writer->write(ByteView(buffer).first(got));
    const BlobRef blob = writer->commit();
    upload.holds.push_back(std::move(writer));
    StoredFile file;
    file.sha256 = blob.sha256;
    file.bytes = blob.bytes;
    return file;
}

void receive_raw(ReceivedUpload& upload, const Request& request, BlobStore& blobs) {
    upload.job.asset =
        store_stream(upload, blobs, [&](std::span<std::byte> into) { return request.body->read(into); });
    upload.job.asset.media_type = told_media_type(request.headers.find("content-type").value_or(""));
    const auto disposition = request.headers.find("content-disposition");
    if (disposition) upload.job.asset.path = header_parameter(*disposition, "filename").value_or("");
}

std::string read_text(MultipartReader& reader) {
    std::string text;
    std::array<std::byte, 4096> some{};
    while (const size_t got = reader.read(some)) {
        text += as_text(ByteView(some).first(got));
        require(text.size() <= max_options_bytes, ErrorCode::request_malformed, "options",
                "the part options is longer than {} bytes", max_options_bytes);
    }
    return text;
}

class FormReceiver {
  public:
    FormReceiver(ReceivedUpload& upload, const Request& request, BlobStore& blobs)
        : upload_(upload), request_(request), blobs_(blobs) {}

    void receive(const HttpLimits& limits) {
        MultipartReader reader(*request_.body, *request_.headers.find("content-type"), limits);
        while (const auto part = reader.next()) take(*part, reader);
        require(has_asset_, ErrorCode::request_malformed, "asset",
                "the form has no part asset; send the asset as -F asset=@FILE does");
    }

  private:
    void take(const Part& part, MultipartReader& reader) {
        if (part.name == "asset") {
            require(!has_asset_, ErrorCode::request_malformed, "asset",
                    "the form has several parts asset; other files are parts resource");
            has_asset_ = true;
            upload_.job.asset = take_file(part, reader);
        } else if (part.name == "resource") {
            require(!part.file_name.empty(), ErrorCode::request_malformed, "resource",
                    "a part resource has no file name, by which the asset could refer to it");
            require(resource_names_.insert(part.file_name).second, ErrorCode::request_malformed, "resource",
                    "the form has two parts resource with the file name {}; give each a name of its own",
                    part.file_name);
            upload_.job.resources.push_back(take_file(part, reader));
        } else if (part.name == "options") {
            require(request_.query.empty() && !has_options_, ErrorCode::option_conflict, "options",
                    "options come in the query or in one part options, not in both");
            has_options_ = true;
            upload_.job.options = parse_options_json(read_text(reader), upload_.job.kind);
        } else {
            fail(ErrorCode::request_malformed, part.name,
                 fmt::format("the form has a part {}; it takes asset, resource and options", part.name));
        }
    }

    StoredFile take_file(const Part& part, MultipartReader& reader) {
        StoredFile file =
            store_stream(upload_, blobs_, [&](std::span<std::byte> into) { return reader.read(into); });
        file.path = part.file_name;
        file.media_type = told_media_type(part.media_type);
        return file;
    }

    ReceivedUpload& upload_;
    const Request& request_;
    BlobStore& blobs_;
    bool has_asset_ = false;
    bool has_options_ = false;
    std::set<std::string> resource_names_;
};

}  // namespace

ReceivedUpload receive_upload(JobKind kind, const Request& request, BlobStore& blobs,
                              const HttpLimits& limits) {
    ReceivedUpload upload;
    upload.job.kind = kind;
    upload.job.options = parse_options(request.query, kind);
    const std::string type = media_type_of(request.headers.find("content-type").value_or(""));
    if (type == "multipart/form-data") {
        FormReceiver(upload, request, blobs).receive(limits);
    } else {
        require(!type.starts_with("multipart/"), ErrorCode::request_type_unsupported, "Content-Type",
                "{} is not taken; send the asset itself, or multipart/form-data", type);
        receive_raw(upload, request, blobs);
    }
    require(upload.job.asset.bytes > 0, ErrorCode::asset_empty, "asset",
            "the asset is empty; send its bytes as the body, or as the part asset of a form");
    return upload;
}

}  // namespace coppice
