// GET /v1/jobs: newest first, page by page.
#include <set>

#include "core/base/error.h"
#include "core/base/number.h"
#include "server/routes/routes.h"

namespace coppice {
namespace {

constexpr size_t default_limit = 100;
constexpr size_t max_limit = 1000;

uint64_t number_of(const std::string& name, const std::string& text, uint64_t least, uint64_t most) {
    const auto number = parse_whole_number(text, least, most);
    require(number.has_value(), ErrorCode::option_invalid, name,
            "{} is \"{}\"; it takes a whole number from {} to {}", name, text, least, most);
    return *number;
}

JobQuery parse_query(const Request& request) {
    JobQuery query;
    query.limit = default_limit;
    std::set<std::string_view> seen;
    for (const auto& [name, value] : request.query) {
        require(seen.insert(name).second, ErrorCode::option_conflict, name, "{} is given twice; give it once",
                name);
        if (name == "status") {
            query.status = job_status_from_name(value);
            require(query.status.has_value(), ErrorCode::option_invalid, name,
                    "status is \"{}\"; it takes queued, running, succeeded, failed or cancelled", value);
        } else if (name == "limit") {
            query.limit = number_of(name, value, 1, max_limit);
        } else if (name == "cursor") {
            query.before = number_of(name, value, 0, UINT64_MAX);
        } else {
            fail(ErrorCode::option_unknown, name,
                 fmt::format("\"{}\" is not known here; it takes status, limit and cursor", name));
        }
    }
    return query;
}

}  // namespace

Route list_jobs_route(Services& services) {
    return {.method = "GET",
            .pattern = "/v1/jobs",
            .handler =
                [&services](Request& request, Response& response) {
                    const JobPage page = services.store.list(parse_query(request));
                    std::string jobs;
                    for (const Job& job : page.jobs) jobs += (jobs.empty() ? "" : ",") + print_job(job);
                    const std::string next = page.next ? "\"" + std::to_string(*page.next) + "\"" : "null";
                    response.json(200, R"({"jobs":[)" + jobs + R"(],"next_cursor":)" + next + "}");
                },
            .takes_options = true};
}

}  // namespace coppice
