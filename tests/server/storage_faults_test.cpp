// A disk that is full or broken: clients are told, the log says why, and the service goes on.
#include <spdlog/logger.h>
#include <spdlog/sinks/ostream_sink.h>

#include <cerrno>
#include <sstream>

#include "tests/server/failing_calls.h"
#include "tests/server/service_fixture.h"
#include "tests/server/test_scenes.h"

namespace coppice::test {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using Call = FailingCalls::Call;

class StorageFaults : public ServiceTest {
  protected:
    void start_logged(WorkFunction work = {}) {
        Parts parts;
        parts.work = std::move(work);
        parts.log = std::make_shared<Log>(std::make_shared<spdlog::logger>(
            "test", std::make_shared<spdlog::sinks::ostream_sink_mt>(lines)));
        start(std::move(parts));
    }

    // The log's only line with this in it; the service has to have ended.
    std::string line_with(const std::string& text) {
        std::istringstream read(lines.str());
        std::string found;
        for (std::string line; std::getline(read, line);) {
            if (line.find(text) == std::string::npos) continue;
            EXPECT_EQ(found, "") << "there are two: " << line;
            found = line;
        }
        return found;
    }

    std::ostringstream lines;
};

TEST_F(StorageFaults, a_full_disk_refuses_an_upload_with_507_and_the_log_has_the_request) {
    start_logged();
    {
        const FailingCalls full(Call::fsync, ENOSPC);
        EXPECT_THAT(post("/v1/jobs", {{"X-Request-Id", "mine-1"}}, iobj_scene()),
                    is_problem(507, "storage.full"));
    }
    EXPECT_EQ(post("/v1/jobs", {}, iobj_scene()).status, 202);
    service->drain();
    EXPECT_THAT(line_with("mine-1"), AllOf(HasSubstr(R"("level":"error")"), HasSubstr(R"("status":507)"),
                                           HasSubstr("No space left on device")));
}

TEST_F(StorageFaults, a_broken_disk_refuses_an_upload_with_503_and_a_time_to_come_back) {
    start_logged();
    {
        const FailingCalls broken(Call::fsync, EIO);
        const Answer answer = post("/v1/jobs", {{"X-Request-Id", "mine-2"}}, iobj_scene());
        EXPECT_THAT(answer, is_problem(503, "storage.failed"));
        EXPECT_FALSE(answer.header("retry-after").empty());
    }
    EXPECT_EQ(get("/readyz").status, 200);
    service->drain();
    EXPECT_THAT(line_with("mine-2"), AllOf(HasSubstr(R"("level":"error")"), HasSubstr("Input/output error")));
}

TEST_F(StorageFaults, a_result_that_cannot_be_stored_fails_the_job_and_the_log_has_the_job) {
    start_logged([](const JobRecord&, BlobStore& blobs, const Watch&) {
        const FailingCalls full(Call::fsync, ENOSPC);
        return result_of(blobs);
    });
    const Answer answer = optimize(iobj_scene(), "", {{"X-Request-Id", "mine-3"}});
    EXPECT_THAT(answer, is_problem(507, "storage.full"));
    const std::string id = answer.header("location").substr(std::string("/v1/jobs/").size());
    service->drain();
    EXPECT_THAT(line_with("job ended"),
                AllOf(HasSubstr(R"("level":"error")"), HasSubstr(id), HasSubstr("No space left on device")));
    EXPECT_THAT(line_with("mine-3"), AllOf(HasSubstr(R"("level":"error")"), HasSubstr(id)));
}

TEST_F(StorageFaults, a_result_whose_bytes_are_lost_is_503_and_the_log_says_which) {
    start_logged();
    const std::string job = submit(iobj_scene());
    wait_for_status(job, "succeeded");
    std::filesystem::remove_all(folder.path() / "data" / "blobs");
    EXPECT_THAT(get(job + "/result", {{"X-Request-Id", "mine-4"}}), is_problem(503, "storage.failed"));
    service->drain();
    EXPECT_THAT(line_with("mine-4"),
                AllOf(HasSubstr(R"("level":"error")"), HasSubstr(job.substr(9)), HasSubstr("are lost")));
}

}  // namespace
}  // namespace coppice::test
