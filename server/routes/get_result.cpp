// GET /v1/jobs/{id}/result: the bytes, whole or one range of them, or nothing where the client has them
// already.
#include <algorithm>

#include "core/base/ascii.h"
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
        const auto next = list.substr(0, list.find(','));
        list.remove_prefix(std::min(next.size() + 1, list.size()));
        auto one = trim(next);
        if (one.starts_with("W/")) one.remove_prefix(2);
        if (one == "*" || one == etag) return true;
    }
    return false;
}

void answer(const Request& request, Response& response, const JobRecord& record, const Services& services) {
    answer_result(response, record, services);
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
    // Only GET knows ranges (RFC 9110, section 14.2).
    if (!wanted || request.method != "GET" || (only_if && *only_if != etag)) return;
    const uint64_t size_bytes = response.content->bytes;
    try {
        const auto range = parse_range(*wanted, size_bytes);
        if (!range) return;
        response.status = 206;
        response.set("Content-Range", fmt::format("bytes {}-{}/{}", range->first, range->last, size_bytes));
        response.content = part_of(std::move(*response.content), *range);
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
                if (record) answer(request, response, *record, services);
            }};
}

}  // namespace coppice
