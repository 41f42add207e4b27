// A whole service on a free port, in this process, and ways to talk to it.
#pragma once

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <condition_variable>
#include <memory>
#include <mutex>
#include <string>

#include "server/app.h"
#include "tests/server/http_client.h"
#include "tests/server/temporary_folder.h"

namespace coppice::test {

// Jobs that end when the test says so.
class Gate {
  public:
    // Work that waits at the gate, looking at its watch, and gives "{}" as result and report.
    WorkFunction work();

    void wait_until_entered(size_t jobs = 1);  // by that many jobs in all
    void open();
    size_t stopped() const;  // jobs that were told to stop at the gate

  private:
    mutable std::mutex mutex_;
    std::condition_variable changed_;
    size_t entered_ = 0;
    size_t stopped_ = 0;
    bool open_ = false;
};

class ServiceTest : public ::testing::Test {
  protected:
    ServiceTest();

    // With the real work, or with what parts say. Returns the port.
    int start(Parts parts = {});
    int start_gated();  // jobs wait at `gate`

    Answer get(const std::string& target, const HeaderList& headers = {}) const;
    Answer post(const std::string& target, const HeaderList& headers, std::string_view body) const;
    Answer optimize(std::string_view asset, const std::string& query = "", HeaderList headers = {}) const;
    // Submits to POST /v1/jobs; the job's path.
    std::string submit(std::string_view asset = "o a\n") const;
    std::string status_of(const std::string& job_path) const;  // "queued", ...
    // Waits for the service to say so, as a client would: by asking again.
    void wait_for_status(const std::string& job_path, const std::string& status) const;

    TemporaryFolder folder;
    Config config;
    Gate gate;

    std::unique_ptr<Service> service;
    int port = 0;
};

// Of "{}", or what is given: both the asset and the report.
Worked result_of(BlobStore& blobs, std::string_view json = "{}");

// What a member of a JSON object's text is, raw: good enough for flat members of known answers.
std::string json_member(const std::string& json, const std::string& name);

// A problem+json with this status and code, whose detail says something.
MATCHER_P2(is_problem, status, code, "is a problem " + std::to_string(status) + " " + code) {
    return arg.status == status && arg.header("content-type") == "application/problem+json" &&
           json_member(arg.body, "code") == "\"" + std::string(code) + "\"" &&
           json_member(arg.body, "detail").size() > 12;
}

}  // namespace coppice::test
