// The one exception of coppice, for bad input and a bad environment. Outcomes (a target that topology
// forbids) are no errors; our own bugs are asserts.
#pragma once

#include <fmt/core.h>

#include <cstdint>
#include <exception>
#include <string>
#include <string_view>
#include <utility>

namespace coppice {

// Stable: clients see name(code). proto/problem maps each to an HTTP status, checked complete at compile
// time.
enum class ErrorCode : uint8_t {
    asset_malformed,              // the bytes are not what their format demands
    asset_unsupported,            // a format, or a feature of one, that is not read
    asset_extension_unsupported,  // extensionsRequired names what is not known
    asset_too_large,              // over a limit, or memory ran out
    asset_ambiguous,              // an archive with several assets and no entry option
    asset_format_mismatch,        // content and declared type contradict each other
    asset_empty,                  // no bytes at all
    asset_no_surface,             // no triangle to compare
    resource_missing,             // a URI that nothing in the upload matches
    resource_forbidden,           // a URI that leaves the upload
    option_unknown,
    option_invalid,
    option_conflict,
    request_malformed,
    request_too_large,
    request_uri_too_long,
    request_timeout,
    request_encoding_unsupported,
    request_type_unsupported,
    range_not_satisfiable,
    route_not_found,
    method_not_allowed,
    job_not_found,
    job_unfinished,
    job_finished,
    job_deleted,
    job_cancelled,
    job_timeout,
    job_quarantined,
    queue_full,
    quota_exceeded,
    service_draining,
    storage_full,
    storage_failed,
    internal,
    count_,  // not a code: how many there are
};

// "asset.malformed" and so on.
std::string_view name(ErrorCode code);

class Error : public std::exception {
  public:
    // where: line and column, JSON pointer, byte offset or option name; empty when the message says it all.
    Error(ErrorCode code, std::string where, std::string message)
        : code_(code), where_(std::move(where)), message_(std::move(message)) {}

    ErrorCode code() const { return code_; }
    const std::string& where() const { return where_; }
    const std::string& message() const { return message_; }
    const char* what() const noexcept override { return message_.c_str(); }

  private:
    ErrorCode code_;
    std::string where_;
    std::string message_;
};

[[noreturn]] void fail(ErrorCode code, std::string where, std::string message);

// Guards input. The message is only formatted when the condition is false.
template <typename... Args>
void require(bool condition, ErrorCode code, std::string_view where, fmt::format_string<Args...> message,
             Args&&... args) {
    if (!condition) fail(code, std::string(where), fmt::format(message, std::forward<Args>(args)...));
}

}  // namespace coppice
