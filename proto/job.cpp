#include "proto/job.h"

#include <fmt/format.h>

#include <array>
#include <nlohmann/json.hpp>

#include "proto/compare_options.h"
#include "proto/json.h"
#include "proto/options.h"

namespace coppice {
namespace {

constexpr auto statuses = std::to_array<std::pair<JobStatus, std::string_view>>({
    {JobStatus::queued, "queued"},
    {JobStatus::running, "running"},
    {JobStatus::succeeded, "succeeded"},
    {JobStatus::failed, "failed"},
    {JobStatus::cancelled, "cancelled"},
});

nlohmann::ordered_json time_or_null(const std::optional<Time>& time) {
    if (!time) return nullptr;
    return print_time(*time);
}

nlohmann::ordered_json links(const Job& job) {
    const std::string self = "/v1/jobs/" + job.id;
    return {{"self", self}, {"result", self + "/result"}, {"report", self + "/report"}};
}

}  // namespace

std::string_view name(JobKind kind) {
    switch (kind) {
        case JobKind::optimize:
            return "optimize";
        case JobKind::inspect:
            return "inspect";
        case JobKind::compare:
            return "compare";
    }
    return {};
}

std::string_view name(JobStatus status) {
    for (const auto& [candidate, text] : statuses) {
        if (candidate == status) return text;
    }
    return {};
}

std::optional<JobStatus> job_status_from_name(std::string_view name) {
    for (const auto& [status, text] : statuses) {
        if (text == name) return status;
    }
    return {};
}

std::string print_time(Time time) {
    const auto day = std::chrono::floor<std::chrono::days>(time);
    const std::chrono::year_month_day date(day);
    const std::chrono::hh_mm_ss clock(time - day);
    return fmt::format("{:04}-{:02}-{:02}T{:02}:{:02}:{:02}.{:03}Z", static_cast<int>(date.year()),
                       static_cast<unsigned>(date.month()), static_cast<unsigned>(date.day()),
                       clock.hours().count(), clock.minutes().count(), clock.seconds().count(),
                       clock.subseconds().count());
}

bool is_finished(JobStatus status) {
    return status != JobStatus::queued && status != JobStatus::running;
}

std::string print_job(const Job& job) {
    nlohmann::ordered_json json;
    json["id"] = job.id;
    json["kind"] = name(job.kind);
    json["status"] = name(job.status);
    json["stage"] = job.stage;
    json["progress"] = job.progress;
    json["attempts"] = job.attempts;
    json["created_at"] = print_time(job.created_at);
    json["started_at"] = time_or_null(job.started_at);
    json["finished_at"] = time_or_null(job.finished_at);
    json["options"] = nlohmann::ordered_json::parse(
        job.kind == JobKind::compare ? print_compare_options(job.comparison) : print_options(job.options));
    json["links"] = links(job);
    if (job.problem) json["problem"] = nlohmann::ordered_json::parse(print_problem(*job.problem));
    return print_json(json);
}

PrintedAroundReport print_around_report(const Job& job) {
    std::string before = print_job(job);
    before.pop_back();
    return {before + ",\"report\":", "}"};
}

}  // namespace coppice
