#include "server/routes/result.h"

#include "core/base/error.h"

namespace coppice {
namespace {

std::string server_timing(const JobResult& result) {
    std::string text;
    for (const auto& [stage, ms] : result.stage_ms) {
        if (ms <= 0 && stage != "total") continue;
        if (!text.empty()) text += ", ";
        text += fmt::format("{};dur={:.1f}", stage, ms);
    }
    return text;
}

bool is_plain(char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '.' ||
           c == '-' || c == '_';
}

}  // namespace

std::string content_disposition(std::string_view file_name) {
    std::string plain;
    std::string encoded;
    for (const char c : file_name) {
        plain += is_plain(c) ? c : '_';
        encoded += is_plain(c) ? std::string(1, c) : fmt::format("%{:02X}", static_cast<unsigned char>(c));
    }
    std::string text = "attachment; filename=\"" + plain + "\"";
    if (plain != file_name) text += "; filename*=UTF-8''" + encoded;
    return text;
}

Content stored_content(const JobRecord& record, const StoredFile& file, const Services& services) {
    const std::shared_ptr<const BlobReader> reader = services.blobs.open(file.sha256);
    if (reader == nullptr) services.store.find(record.job.id);  // throws where that is because it was removed
    require(reader != nullptr, ErrorCode::storage_failed, "", "the bytes {} of the job {} are lost",
            file.sha256, record.job.id);
    return {reader->bytes(),
            [reader](uint64_t offset, std::span<std::byte> into) { return reader->read(offset, into); }};
}

void answer_result(Response& response, const JobRecord& record, const Services& services) {
    const JobResult& result = record.result.value();
    response.status = 200;
    response.content_type = result.file.media_type;
    response.body.clear();
    response.content = stored_content(record, result.file, services);
    response.set("ETag", "\"" + result.file.sha256 + "\"");
    response.set("Cache-Control", "private, no-cache");
    response.set("Server-Timing", server_timing(result));
    if (record.job.kind != JobKind::optimize) return;
    response.set("Link", "</v1/jobs/" + record.job.id + "/report>; rel=\"describedby\"");
    response.set("Content-Disposition", content_disposition(result.file.path));
    response.set("Coppice-Input-Bytes", std::to_string(result.bytes_in));
    response.set("Coppice-Output-Bytes", std::to_string(result.file.bytes));
    response.set("Coppice-Triangles", fmt::format("{};{}", result.triangles_in, result.triangles_out));
    response.set("Coppice-Cache", "miss");
}

}  // namespace coppice
