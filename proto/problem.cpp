#include "proto/problem.h"

#include <array>
#include <cstddef>
#include <new>
#include <nlohmann/json.hpp>

#include "proto/json.h"

namespace coppice {
namespace {

struct Row {
    ErrorCode code;
    int status;
    std::string_view title;
};

// 413 is for the bytes of a body, 415 for what is not read at all, 422 for what an asset holds.
constexpr auto rows = std::to_array<Row>({
    {ErrorCode::asset_malformed, 422, "The asset is malformed"},
    {ErrorCode::asset_unsupported, 415, "The asset's format is not supported"},
    {ErrorCode::asset_extension_unsupported, 422, "The asset requires an extension that is not supported"},
    {ErrorCode::asset_too_large, 422, "The asset is over a limit"},
    {ErrorCode::asset_ambiguous, 400, "The archive holds several assets"},
    {ErrorCode::asset_format_mismatch, 415, "The asset is not what its type says"},
    {ErrorCode::asset_empty, 400, "The asset is empty"},
    {ErrorCode::asset_no_surface, 422, "The asset has no surface to compare"},
    {ErrorCode::resource_missing, 422, "A resource of the asset is missing"},
    {ErrorCode::resource_forbidden, 422, "A resource of the asset lies outside the upload"},
    {ErrorCode::option_unknown, 400, "There is no such option"},
    {ErrorCode::option_invalid, 400, "An option has a value that it does not take"},
    {ErrorCode::option_conflict, 400, "Options exclude each other"},
    {ErrorCode::request_malformed, 400, "The request is malformed"},
    {ErrorCode::request_too_large, 413, "The request is too large"},
    {ErrorCode::request_uri_too_long, 414, "The request's URI is too long"},
    {ErrorCode::request_timeout, 408, "The request came too slowly"},
    {ErrorCode::request_encoding_unsupported, 415, "The request's content encoding is not supported"},
    {ErrorCode::request_type_unsupported, 415, "The request's content type is not supported"},
    {ErrorCode::range_not_satisfiable, 416, "The range cannot be satisfied"},
    {ErrorCode::route_not_found, 404, "There is nothing at this path"},
    {ErrorCode::method_not_allowed, 405, "The path does not take this method"},
    {ErrorCode::job_not_found, 404, "There is no such job"},
    {ErrorCode::job_unfinished, 409, "The job has not finished"},
    {ErrorCode::job_finished, 409, "The job has finished already"},
    {ErrorCode::job_deleted, 410, "The job was deleted"},
    {ErrorCode::job_cancelled, 409, "The job was cancelled"},
    {ErrorCode::job_timeout, 422, "The job took too long"},
    {ErrorCode::job_quarantined, 500, "The job failed repeatedly and was set aside"},
    {ErrorCode::queue_full, 503, "The queue is full"},
    {ErrorCode::quota_exceeded, 429, "A quota is used up"},
    {ErrorCode::service_draining, 503, "The service is shutting down"},
    {ErrorCode::storage_full, 507, "The storage is full"},
    {ErrorCode::storage_failed, 503, "The storage failed"},
    {ErrorCode::internal, 500, "Internal error"},
});

constexpr bool has_every_code_once() {
    if (rows.size() != static_cast<size_t>(ErrorCode::count_)) return false;
    for (size_t i = 0; i < rows.size(); ++i) {
        if (rows[i].code != static_cast<ErrorCode>(i)) return false;
    }
    return true;
}
static_assert(has_every_code_once(), "every ErrorCode has one row, in the order of the enumeration");

const Row& row(ErrorCode code) {
    return rows.at(static_cast<size_t>(code));
}

ErrorCode code_from_name(std::string_view text) {
    for (const Row& candidate : rows) {
        if (name(candidate.code) == text) return candidate.code;
    }
    fail(ErrorCode::request_malformed, "/code", fmt::format("code is {}, which is not a known code", text));
}

std::string text_member(const nlohmann::json& object, const char* member) {
    const auto found = object.find(member);
    if (found == object.end() || !found->is_string()) return {};
    return found->get<std::string>();
}

}  // namespace

int http_status(ErrorCode code) {
    return row(code).status;
}

bool is_our_fault(ErrorCode code) {
    return code == ErrorCode::storage_full || code == ErrorCode::storage_failed ||
           code == ErrorCode::job_quarantined || code == ErrorCode::internal;
}

std::string_view title(ErrorCode code) {
    return row(code).title;
}

Problem to_problem(const Error& error) {
    return {.code = error.code(), .detail = error.message(), .where = error.where()};
}

Problem to_problem(const std::exception& exception, const std::string& log_id) {
    if (const auto* error = dynamic_cast<const Error*>(&exception)) return to_problem(*error);
    if (dynamic_cast<const std::bad_alloc*>(&exception) != nullptr) {
        return {.code = ErrorCode::asset_too_large,
                .detail = "the asset needs more memory than there is; a smaller one would pass",
                .where = {}};
    }
    return {.code = ErrorCode::internal,
            .detail = fmt::format("an error on our side; the service's log has it under {}", log_id),
            .where = {}};
}

std::string print_problem(const Problem& problem) {
    return print_problem(problem, http_status(problem.code));
}

std::string print_problem(const Problem& problem, int status) {
    nlohmann::ordered_json json;
    json["type"] = fmt::format("urn:coppice:problem:{}", name(problem.code));
    json["title"] = title(problem.code);
    json["status"] = status;
    json["detail"] = problem.detail;
    json["code"] = name(problem.code);
    if (!problem.where.empty()) json["where"] = problem.where;
    return print_json(json);
}

Problem parse_problem(std::string_view json) {
    const nlohmann::json object = parse_json(json, {}, "problem");
    require(object.is_object(), ErrorCode::request_malformed, "", "problem is not a JSON object");
    return {.code = code_from_name(text_member(object, "code")),
            .detail = text_member(object, "detail"),
            .where = text_member(object, "where")};
}

}  // namespace coppice
