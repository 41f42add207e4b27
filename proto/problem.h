// RFC 9457 problems: what an Error looks like to a client.
#pragma once

#include <string>

#include "core/base/error.h"

namespace coppice {

struct Problem {
    ErrorCode code = ErrorCode::internal;
    std::string detail;  // what is wrong and what would be right
    std::string where;   // line and column, JSON pointer, byte offset or option name; may be empty
};

int http_status(ErrorCode code);         // complete: a code without a status does not compile
bool is_our_fault(ErrorCode code);       // something broke here: what the log has to know
std::string_view title(ErrorCode code);  // short, the same for every occurrence

Problem to_problem(const Error& error);
// What a caller may know of any exception: Error as it is, bad_alloc as asset_too_large, anything else as
// internal with the given id and no what(), which belongs into the log.
Problem to_problem(const std::exception& exception, const std::string& log_id);

// application/problem+json: {type, title, status, detail, code, where?}. The status is the code's own, or
// that of the answer it goes with: the result of a job that failed is a 409, whatever made it fail.
std::string print_problem(const Problem& problem);
std::string print_problem(const Problem& problem, int status);
Problem parse_problem(std::string_view json);

}  // namespace coppice
