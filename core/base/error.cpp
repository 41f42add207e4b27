#include "core/base/error.h"

namespace coppice {

std::string_view name(ErrorCode code) {
    switch (code) {
        case ErrorCode::asset_malformed:
            return "asset.malformed";
        case ErrorCode::asset_unsupported:
            return "asset.unsupported";
        case ErrorCode::asset_extension_unsupported:
            return "asset.extension_unsupported";
        case ErrorCode::asset_too_large:
            return "asset.too_large";
        case ErrorCode::asset_ambiguous:
            return "asset.ambiguous";
        case ErrorCode::asset_format_mismatch:
            return "asset.format_mismatch";
        case ErrorCode::asset_empty:
            return "asset.empty";
        case ErrorCode::asset_no_surface:
            return "asset.no_surface";
        case ErrorCode::resource_missing:
            return "resource.missing";
        case ErrorCode::resource_forbidden:
            return "resource.forbidden";
        case ErrorCode::option_unknown:
            return "option.unknown";
        case ErrorCode::option_invalid:
            return "option.invalid";
        case ErrorCode::option_conflict:
            return "option.conflict";
        case ErrorCode::request_malformed:
            return "request.malformed";
        case ErrorCode::request_too_large:
            return "request.too_large";
        case ErrorCode::request_uri_too_long:
            return "request.uri_too_long";
        case ErrorCode::request_timeout:
            return "request.timeout";
        case ErrorCode::request_encoding_unsupported:
            return "request.encoding_unsupported";
        case ErrorCode::request_type_unsupported:
            return "request.type_unsupported";
        case ErrorCode::range_not_satisfiable:
            return "range.not_satisfiable";
        case ErrorCode::route_not_found:
            return "route.not_found";
        case ErrorCode::method_not_allowed:
            return "method.not_allowed";
        case ErrorCode::job_not_found:
            return "job.not_found";
        case ErrorCode::job_unfinished:
            return "job.unfinished";
        case ErrorCode::job_finished:
            return "job.finished";
        case ErrorCode::job_deleted:
            return "job.deleted";
        case ErrorCode::job_cancelled:
            return "job.cancelled";
        case ErrorCode::job_timeout:
            return "job.timeout";
        case ErrorCode::job_quarantined:
            return "job.quarantined";
        case ErrorCode::queue_full:
            return "queue.full";
        case ErrorCode::quota_exceeded:
            return "quota.exceeded";
        case ErrorCode::service_draining:
            return "service.draining";
        case ErrorCode::storage_full:
            return "storage.full";
        case ErrorCode::storage_failed:
            return "storage.failed";
        case ErrorCode::internal:
            return "internal";
        case ErrorCode::count_:
            break;
    }
    return "internal";
}

void fail(ErrorCode code, std::string where, std::string message) {
    throw Error(code, std::move(where), std::move(message));
}

}  // namespace coppice
