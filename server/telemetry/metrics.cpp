#include "server/telemetry/metrics.h"

#include <prometheus/counter.h>
#include <prometheus/gauge.h>
#include <prometheus/histogram.h>
#include <prometheus/registry.h>
#include <prometheus/text_serializer.h>

namespace coppice {
namespace {

using prometheus::Counter;
using prometheus::Family;
using prometheus::Gauge;
using prometheus::Histogram;

const Histogram::BucketBoundaries seconds_buckets = {0.001, 0.005, 0.01, 0.05, 0.1, 0.5,
                                                     1,     5,     10,   30,   60,  300};

Family<Counter>& counter(prometheus::Registry& registry, const char* name, const char* help) {
    return prometheus::BuildCounter().Name(name).Help(help).Register(registry);
}

Family<Gauge>& gauge(prometheus::Registry& registry, const char* name, const char* help) {
    return prometheus::BuildGauge().Name(name).Help(help).Register(registry);
}

Family<Histogram>& histogram(prometheus::Registry& registry, const char* name, const char* help) {
    return prometheus::BuildHistogram().Name(name).Help(help).Register(registry);
}

// A method that nobody defined must not become a time series of its own.
std::string known_method(const std::string& method) {
    for (const char* known : {"GET", "HEAD", "POST", "PUT", "DELETE", "PATCH", "OPTIONS"}) {
        if (method == known) return method;
    }
    return "other";
}

}  // namespace

struct Metrics::Families {
    prometheus::Registry registry;
    Family<Counter>& requests = counter(registry, "coppice_http_requests_total", "Requests answered");
    Family<Histogram>& request_seconds = histogram(registry, "coppice_http_request_duration_seconds",
                                                   "From a request's head to the end of its answer");
    Family<Counter>& http_bytes =
        counter(registry, "coppice_http_body_bytes_total", "Bytes of bodies, by direction");
    Family<Counter>& jobs = counter(registry, "coppice_jobs_total", "Jobs that ended");
    Family<Histogram>& job_seconds =
        histogram(registry, "coppice_job_duration_seconds", "From a job's claim to its end");
    Family<Histogram>& stage_seconds =
        histogram(registry, "coppice_stage_duration_seconds", "Stages of jobs that succeeded");
    Family<Counter>& asset_bytes =
        counter(registry, "coppice_asset_bytes_total", "Bytes of assets before and after optimizing");
    Family<Counter>& triangles =
        counter(registry, "coppice_triangles_total", "Stored triangles before and after optimizing");
    Family<Gauge>& jobs_now = gauge(registry, "coppice_jobs", "Jobs in the store, by what they do");
    Gauge& slots = gauge(registry, "coppice_slots", "Jobs that can run at the same time").Add({});
};

Metrics::Metrics() : families_(std::make_unique<Families>()) {}
Metrics::~Metrics() = default;

void Metrics::request_done(const std::string& method, const std::string& route, int status, double seconds,
                           uint64_t bytes_in, uint64_t bytes_out) {
    const std::string known_route = route.empty() ? "none" : route;
    families_->requests
        .Add({{"method", known_method(method)}, {"route", known_route}, {"status", std::to_string(status)}})
        .Increment();
    families_->request_seconds.Add({{"route", known_route}}, seconds_buckets).Observe(seconds);
    families_->http_bytes.Add({{"direction", "in"}}).Increment(static_cast<double>(bytes_in));
    families_->http_bytes.Add({{"direction", "out"}}).Increment(static_cast<double>(bytes_out));
}

void Metrics::job_done(const std::string& kind, const std::string& status, double seconds) {
    families_->jobs.Add({{"kind", kind}, {"status", status}}).Increment();
    families_->job_seconds.Add({{"kind", kind}}, seconds_buckets).Observe(seconds);
}

void Metrics::stage_done(const std::string& stage, double seconds) {
    families_->stage_seconds.Add({{"stage", stage}}, seconds_buckets).Observe(seconds);
}

void Metrics::asset_optimized(uint64_t bytes_in, uint64_t bytes_out, uint64_t triangles_in,
                              uint64_t triangles_out) {
    families_->asset_bytes.Add({{"side", "in"}}).Increment(static_cast<double>(bytes_in));
    families_->asset_bytes.Add({{"side", "out"}}).Increment(static_cast<double>(bytes_out));
    families_->triangles.Add({{"side", "in"}}).Increment(static_cast<double>(triangles_in));
    families_->triangles.Add({{"side", "out"}}).Increment(static_cast<double>(triangles_out));
}

std::string Metrics::print(const Now& now) {
    families_->jobs_now.Add({{"status", "queued"}}).Set(static_cast<double>(now.queued));
    families_->jobs_now.Add({{"status", "running"}}).Set(static_cast<double>(now.running));
    families_->jobs_now.Add({{"status", "finished"}}).Set(static_cast<double>(now.finished));
    families_->slots.Set(static_cast<double>(now.slots));
    return prometheus::TextSerializer().Serialize(families_->registry.Collect());
}

}  // namespace coppice
