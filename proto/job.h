// A job as clients see it.
#pragma once

#include <chrono>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "core/compare/options.h"
#include "core/optimize/options.h"
#include "proto/problem.h"

namespace coppice {

enum class JobKind { optimize, inspect, compare };
enum class JobStatus { queued, running, succeeded, failed, cancelled };
std::string_view name(JobKind kind);
std::string_view name(JobStatus status);
std::optional<JobStatus> job_status_from_name(std::string_view name);

using Time = std::chrono::sys_time<std::chrono::milliseconds>;
std::string print_time(Time time);  // RFC 3339, UTC, milliseconds

struct Job {
    std::string id;  // 32 hex digits of 128 random bits
    JobKind kind = JobKind::optimize;
    JobStatus status = JobStatus::queued;
    std::string stage = "queued";  // queued, read, discover, simplify, encode, write, compare
    double progress = 0;           // 0..1
    uint32_t attempts = 0;
    Time created_at = {};
    std::optional<Time> started_at = {};
    std::optional<Time> finished_at = {};
    OptimizeOptions options = {};
    CompareOptions comparison = {};       // the options of a comparison, which has no others
    std::optional<Problem> problem = {};  // once failed or cancelled
};

bool is_finished(JobStatus status);

// {id, kind, status, stage, progress, attempts, created_at, ..., options, links {self, result, report},
// problem?}
std::string print_job(const Job& job);

// What stands before and after the member `report`, once the job succeeded: its JSON text (of an inspection
// or a comparison: itself) can be long, and goes in as it is.
struct PrintedAroundReport {
    std::string before, after;
};
PrintedAroundReport print_around_report(const Job& job);

}  // namespace coppice
