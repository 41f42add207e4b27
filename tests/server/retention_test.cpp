#include "server/jobs/retention.h"

#include <gtest/gtest.h>

#include "server/blobs/disk_blobs.h"
#include "server/store/memory_store.h"
#include "tests/server/temporary_folder.h"

namespace coppice {
namespace {

using namespace std::chrono_literals;

class Retention : public ::testing::Test {
  protected:
    BlobRef put(std::string_view text) {
        const auto writer = blobs.create();
        writer->write(as_bytes(text));
        return writer->commit();
    }
    std::string finished_job(std::string_view asset, std::string_view result) {
        NewJob job;
        job.asset.sha256 = put(asset).sha256;
        const std::string id = store.submit(std::move(job)).id;
        const auto claim = store.claim();
        JobResult made;
        made.file.sha256 = put(result).sha256;
        made.report.sha256 = put(std::string("report of ").append(result)).sha256;
        store.complete(id, claim->token, std::move(made));
        return id;
    }

    test::TemporaryFolder folder;
    DiskBlobs blobs{folder.path()};
    Time now = Time(24h * 365 * 50);
    MemoryStore store{{}, [this] { return now; }};
};

TEST_F(Retention, removing_a_job_removes_its_bytes_but_none_that_another_job_names) {
    const std::string first = finished_job("same scene", "result 1");
    finished_job("same scene", "result 2");
    remove_job(first, store, blobs);
    EXPECT_EQ(blobs.list().size(), 3U);
}

TEST_F(Retention, old_jobs_go_with_their_bytes) {
    finished_job("a", "b");
    now += 2h;
    finished_job("c", "d");
    EXPECT_EQ(remove_expired({.age = 1h, .jobs = 10}, now, store, blobs), 1U);
    EXPECT_EQ(blobs.list().size(), 3U);
    EXPECT_EQ(remove_expired({.age = 1h, .jobs = 0}, now, store, blobs), 1U);
    EXPECT_TRUE(blobs.list().empty());
}

TEST_F(Retention, bytes_that_no_job_names_go_and_an_upload_that_is_not_submitted_yet_stays) {
    put("left over");
    const auto upload = blobs.create();
    upload->write(as_bytes("just arrived"));
    const BlobRef arrived = upload->commit();
    finished_job("a", "b");
    EXPECT_EQ(remove_unreferenced(store, blobs), 1U);
    EXPECT_NE(blobs.open(arrived.sha256), nullptr);
}

}  // namespace
}  // namespace coppice
