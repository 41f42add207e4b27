#include "server/http/answer.h"

#include <array>
#include <ctime>
#include <new>

namespace coppice {
namespace {

void set_default(Response& response, const char* name, std::string value) {
    if (!response.has(name)) response.set(name, std::move(value));
}

std::string http_date() {
    const std::time_t now = std::time(nullptr);
    std::tm utc{};
    ::gmtime_r(&now, &utc);
    std::array<char, 64> text{};
    const size_t length = std::strftime(text.data(), text.size(), "%a, %d %b %Y %H:%M:%S GMT", &utc);
    return {text.data(), length};
}

void refuse_options(const Request& request) {
    if (request.query.empty()) return;
    const std::string name =
        request.query.front().first.substr(0, 64);  // of any option: what is longer is cut
    fail(ErrorCode::option_unknown, name,
         fmt::format("\"{}\" is not known here; this path takes no options", name));
}

}  // namespace

void set_problem(Response& response, const Problem& problem) {
    set_problem(response, problem, http_status(problem.code));
}

void set_problem(Response& response, const Problem& problem, int status) {
    response.status = status;
    response.content_type = "application/problem+json";
    response.body = print_problem(problem, status);
    response.content.reset();
    if (is_our_fault(problem.code)) response.fault = problem.detail;
    if (response.status == 503 || response.status == 429) set_default(response, "Retry-After", "2");
}

void set_problem_of_current_exception(Response& response, const std::string& request_id) {
    try {
        throw;
    } catch (const Error& error) {
        set_problem(response, to_problem(error));
    } catch (const std::exception& exception) {
        set_problem(response, to_problem(exception, request_id));
        response.fault = exception.what();
    } catch (...) {
        set_problem(response,
                    {ErrorCode::internal, "something went wrong; the log knows it as " + request_id, {}});
        response.fault = "not a std::exception";
    }
}

std::string answer(const Router& router, Request& request, Response& response, bool only_always) {
    std::string pattern;
    try {
        const Route& route = router.find(request, response);
        pattern = route.pattern;
        require(!only_always || route.always, ErrorCode::queue_full, "",
                "the service has as many connections as it takes (http_connections); try again soon");
        if (!route.takes_options) refuse_options(request);
        route.handler(request, response);
    } catch (...) {
        set_problem_of_current_exception(response, request.id);
    }
    return pattern;
}

void set_common_headers(Response& response, const std::string& request_id) {
    response.set("Date", http_date());
    response.set("X-Request-Id", request_id);
    response.set("X-Content-Type-Options", "nosniff");
    set_default(response, "Cache-Control", "no-store");
}

}  // namespace coppice
