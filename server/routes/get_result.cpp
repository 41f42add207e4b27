// GET /v1/jobs/{id}/result: the bytes, whole or one range of them, or nothing where the client has them
// already.
#include <algorithm>

#include "core/base/error.h"
#include "server/http/range.h"
#include "server/routes/finished_job.h"
#include "server/routes/result.h"
#include "server/routes/routes.h"

namespace coppice {
namespace {

// If-None-Match compares weakly: W/ makes no difference (RFC 9110, section 13.1.2).
bool names_entity(std::string_view list, std::string_view etag) {
    while (!list.empty()) {
        auto one = list.substr(0, list.find(','));
        list.remove_prefix(std::min(one.size() + 1, list.size()));
        while (one.starts_with(' ')) one.remove_prefix(1);
        while (one.ends_with(' ')) one.remove_suffix(1);
        if (one.starts_with("W/")) one.remove_prefix(2);
        if (one == "*" || one == etag) return true;
    }
    return false;
}

void narrow(Response& response, const ByteRange& range, uint64_t size_bytes) {
    const auto read_whole = response.content->read;
    response.status = 206;
    response.set("Content-Range", fmt::format("bytes {}-{}/{}", range.first, range.last, size_bytes));
    response.content =
        Content{range.bytes(), [read_whole, range](uint64_t offset, std::span<std::byte> into) {
                    const uint64_t left = range.bytes() - std::min(offset, range.bytes());
                    return read_whole(range.first + offset,
                                      into.first(static_cast<size_t>(std::min<uint64_t>(into.size(), left))));
                }};
}

void answer(const Request& request, Response& response, const JobRecord& record, const BlobStore& blobs) {
    answer_result(response, record, blobs);
    response.set("Accept-Ranges", "bytes");
    const std::string etag = "\"" + record.result->file.sha256 + "\"";
    if (names_entity(request.headers.joined("if-none-match"), etag)) {
        response.status = 304;
        response.content_type.clear();
        response.content.reset();
        return;
    }
    const auto wanted = request.headers.find("range");
    const auto only_if = request.headers.find("if-range");
    if (!wanted || (only_if && *only_if != etag)) return;
    const uint64_t size_bytes = response.content->bytes;
    try {
        const auto range = parse_range(*wanted, size_bytes);
        if (range) narrow(response, *range, size_bytes);
    } catch (const Error&) {
        response.headers.clear();  // they are the result's, and a problem is answered
        response.set("Content-Range", fmt::format("bytes */{}", size_bytes));
        throw;
    }
}

}  // namespace

Route get_result_route(Services& services) {
    return {"GET", "/v1/jobs/{id}/result", [&services](Request& request, Response& response) {
                const auto record = find_succeeded(request, response, services.store);
                if (record) answer(request, response, *record, services.blobs);
            }};
}

}  // namespace coppice
