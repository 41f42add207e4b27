// From a request to its answer: finding the handler, running it, and turning what it throws into a problem.
#pragma once

#include <exception>
#include <string>

#include "proto/problem.h"
#include "server/http/message.h"
#include "server/http/router.h"

namespace coppice {

void set_problem(Response& response, const Problem& problem);  // with the status of its code
void set_problem(Response& response, const Problem& problem, int status);

struct Answered {
    std::string route;           // its pattern; empty where none matched
    std::string internal_error;  // what the log has to know and the client must not
};

// Never throws. only_always: connections are over their limit, and routes that are not Route::always answer
// 503.
Answered answer(const Router& router, Request& request, Response& response, bool only_always);

// For use in a catch block: sets the problem of the exception that is being handled and returns what the log
// needs.
std::string set_problem_of_current_exception(Response& response, const std::string& request_id);

// Header fields that every answer carries.
void set_common_headers(Response& response, const std::string& request_id);

}  // namespace coppice
