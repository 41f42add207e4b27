#include "server/blobs/disk_blobs.h"

#include <sys/resource.h>

#include <csignal>
#include <fstream>

#include "tests/server/blob_store_suite.h"
#include "tests/server/temporary_folder.h"

namespace coppice {
namespace {

using test::fails_with;
using test::TemporaryFolder;

std::shared_ptr<BlobStore> disk_blobs_in_new_folder() {
    struct Both {
        TemporaryFolder folder;
        DiskBlobs blobs{folder.path()};
    };
    auto both = std::make_shared<Both>();
    return {both, &both->blobs};
}

}  // namespace

namespace test {
INSTANTIATE_TEST_SUITE_P(Disk, BlobStoreSuite,
                         ::testing::Values(BlobStoreFactory{"disk", disk_blobs_in_new_folder}));
}  // namespace test

namespace {

TEST(DiskBlobs, survive_a_restart_and_half_written_ones_do_not) {
    const TemporaryFolder folder;
    BlobRef blob;
    {
        DiskBlobs blobs(folder.path());
        const auto writer = blobs.create();
        writer->write(as_bytes("hello"));
        blob = writer->commit();
    }
    std::ofstream(folder.path() / "incoming" / "7") << "half";
    const DiskBlobs again(folder.path());
    EXPECT_EQ(as_text(load_blob(again, blob)), "hello");
    EXPECT_TRUE(std::filesystem::is_empty(folder.path() / "incoming"));
}

TEST(DiskBlobs, a_folder_belongs_to_one_process) {
    const TemporaryFolder folder;
    const DiskBlobs first(folder.path());
    EXPECT_THAT([&] { DiskBlobs second(folder.path()); },
                fails_with(ErrorCode::storage_failed, "another process"));
}

TEST(DiskBlobs, a_folder_that_cannot_be_made_is_named) {
    EXPECT_THAT([] { DiskBlobs blobs("/proc/none"); }, fails_with(ErrorCode::storage_failed, "/proc/none"));
}

// /dev/full answers ENOSPC to every write, as a full disk does.
TEST(DiskBlobs, a_full_disk_is_storage_full_and_leaves_nothing) {
    const TemporaryFolder folder;
    DiskBlobs blobs(folder.path());
    std::filesystem::create_symlink("/dev/full", folder.path() / "incoming" / "probe");
    EXPECT_THAT([&] { blobs.check_writable(); }, fails_with(ErrorCode::storage_full, "No space left"));
    EXPECT_NO_THROW(blobs.check_writable());
}

}  // namespace
}  // namespace coppice
