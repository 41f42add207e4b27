#include "server/app.h"

#include <pthread.h>
#include <csignal>
#include <cstdlib>
#include <thread>

#include "core/base/error.h"
#include "server/blobs/disk_blobs.h"
#include "server/http/server.h"
#include "server/jobs/retention.h"
#include "server/jobs/runner.h"
#include "server/routes/routes.h"
#include "server/store/memory_store.h"

namespace coppice {
namespace {

using namespace std::chrono_literals;

constexpr auto retention_every = 60s;
constexpr auto last_answers_time = 5s;  // after the jobs have ended, for the answers that say so

unsigned cores() {
    return std::max(1U, std::thread::hardware_concurrency());
}

unsigned slots(const Config& config) {
    return config.slots == 0 ? cores() : config.slots;
}

RouteSettings route_settings(const Config& config) {
    RouteSettings settings;
    settings.http = config.http;
    settings.queue_length = config.queue_length;
    settings.wait = config.wait;
    settings.slots = slots(config);
    return settings;
}

Log::Fields describe(const Exchange& exchange) {
    Log::Fields fields = {{"id", exchange.request_id},
                          {"method", exchange.method},
                          {"path", exchange.path},
                          {"status", static_cast<int64_t>(exchange.status)},
                          {"bytes_in", static_cast<int64_t>(exchange.bytes_in)},
                          {"bytes_out", static_cast<int64_t>(exchange.bytes_out)},
                          {"ms", exchange.time.count() * 1000},
                          {"address", exchange.remote_address}};
    if (!exchange.job.empty()) fields.emplace_back("job", exchange.job);
    if (!exchange.fault.empty()) fields.emplace_back("error", exchange.fault);
    if (exchange.count > 1) fields.emplace_back("count", static_cast<int64_t>(exchange.count));
    return fields;
}

}  // namespace

struct Service::State {
    State(const Config& given, Parts parts)
        : config(given),
          log(parts.log ? std::move(parts.log) : std::make_shared<Log>()),
          now(parts.now),
          blobs(config.data),
          store({.queued = config.queue_length}, parts.now),
          services{store, blobs, metrics, route_settings(config), draining.get_token(), ended.get_token()},
          runner(store, blobs, parts.work ? std::move(parts.work) : real_work(),
                 {.slots = slots(config), .job_time = config.job_time}, *log, metrics),
          http(make_router(services), config.http, [this](const Exchange& exchange) { observe(exchange); }) {}

    WorkFunction real_work() {
        const unsigned threads = std::max(1U, cores() / slots(config));
        return [this, threads](const JobRecord& record, BlobStore& store_of_bytes, const Watch& watch) {
            return work(record, store_of_bytes, config.read, threads, watch);
        };
    }

    void observe(const Exchange& exchange) {
        for (uint64_t i = 0; i < exchange.count; ++i) {
            metrics.request_done(exchange.method, exchange.route, exchange.status, exchange.time.count(),
                                 exchange.bytes_in, exchange.bytes_out);
        }
        const auto fields = describe(exchange);
        exchange.fault.empty() ? log->info("request", fields) : log->error("request", fields);
    }

    void tidy_now_and_then(const std::stop_token& stop) {
        std::mutex mutex;
        std::condition_variable_any never;
        while (!stop.stop_requested()) {
            try {
                const size_t jobs = remove_expired({config.keep_time, config.keep_jobs}, now(), store, blobs);
                const size_t left_over = remove_unreferenced(store, blobs);
                if (jobs + left_over > 0) {
                    log->info("tidied", {{"jobs", static_cast<int64_t>(jobs)},
                                         {"blobs", static_cast<int64_t>(left_over)}});
                }
            } catch (const std::exception& exception) {
                log->error("tidying", {{"error", std::string(exception.what())}});
            }
            std::unique_lock lock(mutex);
            never.wait_for(lock, stop, retention_every, [] { return false; });
        }
    }

    Config config;
    std::shared_ptr<const Log> log;
    NowFunction now;
    Metrics metrics;
    DiskBlobs blobs;
    MemoryStore store;
    std::stop_source draining;
    std::stop_source ended;
    Services services;
    Runner runner;
    HttpServer http;
    int port = 0;
    std::jthread tidying;
};

Service::Service(const Config& config, Parts parts)
    : state_(std::make_unique<State>(config, std::move(parts))) {
    State& state = *state_;
    const ListenAddress address = parse_listen(config.listen);
    state.runner.start();
    state.port = state.http.start(address.host, address.port);
    state.tidying = std::jthread([&state](const std::stop_token& stop) { state.tidy_now_and_then(stop); });
    state.log->info("listening", {{"address", address.host},
                                  {"port", static_cast<int64_t>(state.port)},
                                  {"slots", static_cast<int64_t>(state.services.settings.slots)},
                                  {"data", config.data},
                                  {"version", std::string(COPPICE_VERSION)}});
}

Service::~Service() {
    drain();
}

int Service::port() const {
    return state_->port;
}

void Service::drain() {
    State& state = *state_;
    if (!state.draining.request_stop()) return;
    state.log->info("draining");
    state.runner.drain(state.config.drain_time);
    state.ended.request_stop();
    state.http.stop(last_answers_time);
    state.log->info("stopped");
}

int run_service(const Config& config) {
    sigset_t signals;
    sigemptyset(&signals);
    sigaddset(&signals, SIGTERM);
    sigaddset(&signals, SIGINT);
    // Blocked before any thread is there, so that all inherit it and only sigwait sees them; as the first
    // process of a container, too, where unhandled signals would be lost.
    pthread_sigmask(SIG_BLOCK, &signals, nullptr);
    Service service(config);
    int received = 0;
    sigwait(&signals, &received);
    std::thread([signals] {
        int again = 0;
        sigwait(&signals, &again);
        std::_Exit(1);
    }).detach();
    service.drain();
    return 0;
}

}  // namespace coppice
