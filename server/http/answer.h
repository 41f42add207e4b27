// From a request to its answer: finding the handler, running it, and turning what it throws into a problem.
#pragma once

#include <exception>
#include <string>

#include "proto/problem.h"
#include "server/http/message.h"
#include "server/http/router.h"

namespace coppice {

// With the status of its code, or another. What is our fault goes to the log too.
void set_problem(Response& response, const Problem& problem);
void set_problem(Response& response, const Problem& problem, int status);

// For use in a catch block: sets the problem of the exception that is being handled.
void set_problem_of_current_exception(Response& response, const std::string& request_id);

// Returns the route's pattern; empty where none matched. Never throws. only_always: connections are over
// their limit, and routes that are not Route::always answer 503.
std::string answer(const Router& router, Request& request, Response& response, bool only_always);

// Header fields that every answer carries.
void set_common_headers(Response& response, const std::string& request_id);

}  // namespace coppice
