#include "server/routes/upload.h"

#include <array>
#include <optional>
#include <set>

#include "core/base/error.h"
#include "core/format/detect.h"
#include "proto/compare_options.h"
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

// Two parts of a form, and where their files go.
struct FormAsset {
    std::string asset_part, resource_part;
    StoredFile* asset;
    std::vector<StoredFile>* resources;
    bool is_there = false;
    std::set<std::string> resource_names = {};
};

class FormReceiver {
  public:
    FormReceiver(ReceivedUpload& upload, const Request& request, BlobStore& blobs)
        : upload_(upload), request_(request), blobs_(blobs) {
        NewJob& job = upload.job;
        if (job.kind == JobKind::compare) {
            StoredUpload& candidate = job.candidate.emplace();
            assets_.push_back({"reference", "reference_resource", &job.asset, &job.resources});
            assets_.push_back({"candidate", "candidate_resource", &candidate.asset, &candidate.resources});
        } else {
            assets_.push_back({"asset", "resource", &job.asset, &job.resources});
        }
    }

    void receive(const HttpLimits& limits) {
        MultipartReader reader(*request_.body, *request_.headers.find("content-type"), limits);
        while (const auto part = reader.next()) take(*part, reader);
        for (const FormAsset& of : assets_) {
            require(of.is_there, ErrorCode::request_malformed, of.asset_part,
                    "the form has no part {0}; send the {0} as -F {0}=@FILE does", of.asset_part);
            require(of.asset->bytes > 0, ErrorCode::asset_empty, of.asset_part,
                    "the {0} is empty; send its bytes as the {1}part {0} of a form", of.asset_part,
                    of.asset_part == "asset" ? "body, or as the " : "");
        }
    }

  private:
    void take(const Part& part, MultipartReader& reader) {
        for (FormAsset& of : assets_) {
            if (part.name == of.asset_part) return take_asset(of, part, reader);
            if (part.name == of.resource_part) return take_resource(of, part, reader);
        }
        require(part.name == "options", ErrorCode::request_malformed, part.name,
                "the form has a part {}; it takes {}", part.name,
                assets_.size() == 1
                    ? "asset, resource and options"
                    : "reference, candidate, reference_resource, candidate_resource and options");
        require(request_.query.empty() && !has_options_, ErrorCode::option_conflict, "options",
                "options come in the query or in one part options, not in both");
        has_options_ = true;
        NewJob& job = upload_.job;
        if (job.kind == JobKind::compare) {
            job.comparison = parse_compare_options_json(read_text(reader));
        } else {
            job.options = parse_options_json(read_text(reader), job.kind);
        }
    }

    void take_asset(FormAsset& of, const Part& part, MultipartReader& reader) {
        require(!of.is_there, ErrorCode::request_malformed, of.asset_part,
                "the form has several parts {}; other files are parts {}", of.asset_part, of.resource_part);
        of.is_there = true;
        *of.asset = take_file(part, reader);
    }

    void take_resource(FormAsset& of, const Part& part, MultipartReader& reader) {
        require(!part.file_name.empty(), ErrorCode::request_malformed, of.resource_part,
                "a part {} has no file name, by which the asset could refer to it", of.resource_part);
        require(of.resource_names.insert(part.file_name).second, ErrorCode::request_malformed,
                of.resource_part,
                "the form has two parts {} with the file name {}; give each a name of its own",
                of.resource_part, part.file_name);
        of.resources->push_back(take_file(part, reader));
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
    std::vector<FormAsset> assets_;
    bool has_options_ = false;
};

}  // namespace

ReceivedUpload receive_upload(JobKind kind, const Request& request, BlobStore& blobs,
                              const HttpLimits& limits) {
    ReceivedUpload upload;
    upload.job.kind = kind;
    if (kind == JobKind::compare) {
        upload.job.comparison = parse_compare_options(request.query);
    } else {
        upload.job.options = parse_options(request.query, kind);
    }
    const std::string type = media_type_of(request.headers.find("content-type").value_or(""));
    if (type == "multipart/form-data") {
        FormReceiver(upload, request, blobs).receive(limits);
    } else {
        require(kind != JobKind::compare, ErrorCode::request_type_unsupported, "Content-Type",
                "two assets are compared, which come as multipart/form-data, with the parts reference and "
                "candidate: -F reference=@FILE -F candidate=@FILE");
        require(!type.starts_with("multipart/"), ErrorCode::request_type_unsupported, "Content-Type",
                "{} is not taken; send the asset itself, or multipart/form-data", type);
        receive_raw(upload, request, blobs);
        require(upload.job.asset.bytes > 0, ErrorCode::asset_empty, "asset",
                "the asset is empty; send its bytes as the body, or as the part asset of a form");
    }
    return upload;
}

}  // namespace coppice
