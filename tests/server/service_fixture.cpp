#include "tests/server/service_fixture.h"

#include <spdlog/logger.h>
#include <spdlog/sinks/null_sink.h>

#include <chrono>
#include <thread>

namespace coppice::test {

using namespace std::chrono_literals;

WorkFunction Gate::work() {
    return [this](const JobRecord&, BlobStore& blobs, const Watch& watch) {
        std::unique_lock lock(mutex_);
        ++entered_;
        changed_.notify_all();
        while (!open_) {
            changed_.wait_for(lock, 1ms);
            if (!watch.stop.stop_requested()) continue;
            ++stopped_;
            changed_.notify_all();
            watch.check();
        }
        return result_of(blobs);
    };
}

Worked result_of(BlobStore& blobs, std::string_view json) {
    Worked worked;
    worked.result.file = store_bytes(worked, blobs, as_bytes(json), "scene.glb", "model/gltf-binary");
    worked.result.report = worked.result.file;
    return worked;
}

void Gate::wait_until_entered(size_t jobs) {
    std::unique_lock lock(mutex_);
    ASSERT_TRUE(changed_.wait_for(lock, 20s, [&] { return entered_ >= jobs; })) << "no job came to the gate";
}

void Gate::open() {
    const std::scoped_lock lock(mutex_);
    open_ = true;
    changed_.notify_all();
}

size_t Gate::stopped() const {
    const std::scoped_lock lock(mutex_);
    return stopped_;
}

ServiceTest::ServiceTest() {
    config.listen = "127.0.0.1:0";
    config.data = folder.path() / "data";
    config.slots = 1;
    config.drain_time = 0s;  // jobs at a gate that nobody opens are given back
}

int ServiceTest::start(Parts parts) {
    if (!parts.log) {
        parts.log = std::make_shared<Log>(
            std::make_shared<spdlog::logger>("quiet", std::make_shared<spdlog::sinks::null_sink_mt>()));
    }
    service = std::make_unique<Service>(config, std::move(parts));
    return port = service->port();
}

int ServiceTest::start_gated() {
    Parts parts;
    parts.work = gate.work();
    return start(std::move(parts));
}

Answer ServiceTest::get(const std::string& target, const HeaderList& headers) const {
    return request(port, "GET", target, headers);
}

Answer ServiceTest::post(const std::string& target, const HeaderList& headers, std::string_view body) const {
    return request(port, "POST", target, headers, body);
}

Answer ServiceTest::optimize(std::string_view asset, const std::string& query, HeaderList headers) const {
    return post("/v1/optimize" + query, headers, asset);
}

std::string ServiceTest::submit(std::string_view asset) const {
    const Answer answer = post("/v1/jobs", {}, asset);
    EXPECT_EQ(answer.status, 202) << answer.body;
    return answer.header("location");
}

std::string ServiceTest::status_of(const std::string& job_path) const {
    std::string status = json_member(get(job_path).body, "status");
    return status.size() > 2 ? status.substr(1, status.size() - 2) : status;
}

void ServiceTest::wait_for_status(const std::string& job_path, const std::string& status) const {
    const auto end = std::chrono::steady_clock::now() + 20s;
    while (status_of(job_path) != status) {
        ASSERT_LT(std::chrono::steady_clock::now(), end) << "the job is " << status_of(job_path);
        std::this_thread::sleep_for(2ms);
    }
}

std::string json_member(const std::string& json, const std::string& name) {
    const std::string key = "\"" + name + "\":";
    const auto begin = json.find(key);
    if (begin == std::string::npos) return {};
    size_t at = begin + key.size();
    if (json[at] != '"') return json.substr(at, json.find_first_of(",}", at) - at);
    size_t end = at + 1;
    while (end < json.size() && json[end] != '"') end += json[end] == '\\' ? 2 : 1;
    return json.substr(at, end - at + 1);
}

}  // namespace coppice::test
