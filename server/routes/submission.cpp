#include "server/routes/submission.h"

#include <algorithm>
#include <utility>

#include "core/base/ascii.h"
#include "core/base/error.h"
#include "core/base/number.h"
#include "server/http/answer.h"
#include "server/routes/result.h"
#include "server/routes/upload.h"

namespace coppice {
namespace {

using Clock = std::chrono::steady_clock;
using namespace std::chrono_literals;

constexpr auto look_after_client_every = 500ms;

class CountedWait {
  public:
    explicit CountedWait(std::atomic<size_t>& waiting) : waiting_(waiting), place_(waiting_++) {}
    ~CountedWait() { --waiting_; }
    CountedWait(const CountedWait&) = delete;
    CountedWait& operator=(const CountedWait&) = delete;

    size_t place() const { return place_; }

  private:
    std::atomic<size_t>& waiting_;
    size_t place_;
};

// A preference and its value, which may stand in quotes; parameters after ';' mean nothing to us.
std::pair<std::string, std::string_view> split_preference(std::string_view text) {
    text = text.substr(0, text.find(';'));
    const auto equals = std::min(text.find('='), text.size());
    return {lower(trim(text.substr(0, equals))),
            trim(text.substr(std::min(equals + 1, text.size())), " \t\"")};
}

}  // namespace

Job submit_upload(JobKind kind, Request& request, Response& response, Services& services) {
    require_room(services);
    ReceivedUpload upload = receive_upload(kind, request, services.blobs, services.settings.http);
    require_room(services);  // the body may have taken long, and draining begun
    Job job = services.store.submit(std::move(upload.job));
    response.job = job.id;
    response.set("Location", "/v1/jobs/" + job.id);
    return job;
}

void answer_accepted(Response& response, const Job& job) {
    response.json(202, print_job(job));
    response.set("Location", "/v1/jobs/" + job.id);
    if (!is_finished(job.status)) response.set("Retry-After", "1");
}

Preference parse_preference(const Headers& headers, const RouteSettings& settings) {
    Preference preference{settings.wait, {}};
    bool asynchronous = false;
    std::optional<std::chrono::seconds> asked;
    const std::string all = headers.joined("prefer");
    std::string_view rest = all;
    while (!rest.empty()) {
        const auto one = rest.substr(0, rest.find(','));
        rest.remove_prefix(std::min(one.size() + 1, rest.size()));
        const auto [name, value] = split_preference(one);
        if (name == "respond-async") asynchronous = true;
        // Others may be ignored, and of the same one the first counts (RFC 7240, section 2).
        if (name != "wait" || asked) continue;
        const auto seconds = parse_whole_number(value);
        require(seconds.has_value(), ErrorCode::request_malformed, "Prefer",
                "Prefer has {}; it takes wait=SECONDS and respond-async", trim(one));
        const auto most = static_cast<uint64_t>(settings.max_wait.count());
        asked = std::chrono::seconds(std::min(*seconds, most));
    }
    if (asynchronous) preference = {0s, "respond-async"};
    if (asked) {
        preference.wait = *asked;
        preference.applied += (asynchronous ? ", wait=" : "wait=") + std::to_string(asked->count());
    }
    return preference;
}

std::optional<JobRecord> wait_for_job(const Job& job, const Request& request, const Preference& preference,
                                      Services& services) {
    const CountedWait counted(services.waiting);
    const bool has_room = counted.place() < services.settings.waiting_clients;
    const auto end = Clock::now() + (has_room ? preference.wait : 0s);
    try {
        for (;;) {
            JobRecord record = services.store.find(job.id);
            const auto left = std::chrono::ceil<std::chrono::milliseconds>(end - Clock::now());
            if (is_finished(record.job.status) || left <= 0ms || request.client_is_gone()) return record;
            require(!services.ended.stop_requested(), ErrorCode::service_draining, "",
                    "the service shuts down before the job has ended");
            services.store.wait_until_finished(
                job.id, services.ended, std::min<std::chrono::milliseconds>(left, look_after_client_every));
        }
    } catch (const Error& error) {
        if (error.code() == ErrorCode::job_deleted) return std::nullopt;
        throw;
    }
}

void submit_and_wait(JobKind kind, Request& request, Response& response, Services& services) {
    const Preference preference = parse_preference(request.headers, services.settings);
    const Job job = submit_upload(kind, request, response, services);
    if (!preference.applied.empty()) response.set("Preference-Applied", preference.applied);
    const auto record = wait_for_job(job, request, preference, services);
    require(record.has_value(), ErrorCode::job_deleted, "", "the job {} was deleted", job.id);
    if (!is_finished(record->job.status)) {
        answer_accepted(response, record->job);
    } else if (record->result) {
        answer_result(response, *record, services);
    } else {
        set_problem(response, record->job.problem.value());
    }
}

Route submit_and_wait_route(std::string path, JobKind kind, Services& services) {
    return {.method = "POST",
            .pattern = std::move(path),
            .handler = [kind, &services](
                           Request& request,
                           Response& response) { submit_and_wait(kind, request, response, services); },
            .takes_options = true};
}

}  // namespace coppice
