#include "server/blobs/disk_blobs.h"

#include <sys/resource.h>

#include <csignal>
#include <fstream>

#include "tests/server/blob_store_suite.h"
#include "tests/server/plain_user.h"
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

BlobRef put(DiskBlobs& blobs, std::string_view text) {
    const auto writer = blobs.create();
    writer->write(as_bytes(text));
    return writer->commit();
}

TEST(DiskBlobs, survive_a_restart_and_half_written_ones_do_not) {
    const TemporaryFolder folder;
    BlobRef blob;
    {
        DiskBlobs blobs(folder.path());
        blob = put(blobs, "hello");
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

// While it lives, names can be added to the folder, but it cannot be opened, and so not be synced.
class Unsyncable {
  public:
    explicit Unsyncable(std::filesystem::path folder) : folder_(std::move(folder)) {
        using std::filesystem::perms;
        std::filesystem::permissions(folder_, perms::owner_write | perms::owner_exec);
    }
    ~Unsyncable() { std::filesystem::permissions(folder_, std::filesystem::perms::owner_all); }
    Unsyncable(const Unsyncable&) = delete;
    Unsyncable& operator=(const Unsyncable&) = delete;

  private:
    std::filesystem::path folder_;
};

// Else the same bytes, uploaded again, would be taken for safe.
TEST(DiskBlobs, a_blob_whose_folder_cannot_be_synced_is_not_left_to_be_found) {
    test::as_plain_user([] {
        const TemporaryFolder folder;
        DiskBlobs blobs(folder.path());
        const BlobRef blob = put(blobs, "hello");
        const auto path = folder.path() / "blobs" / blob.sha256.substr(0, 2);
        EXPECT_TRUE(blobs.remove(blob.sha256, [] { return false; }));
        {
            const Unsyncable unsyncable(path);
            EXPECT_THAT([&] { put(blobs, "hello"); },
                        fails_with(ErrorCode::storage_failed, "Permission denied"));
            EXPECT_EQ(blobs.open(blob.sha256), nullptr);
        }
        EXPECT_EQ(put(blobs, "hello"), blob);
        EXPECT_EQ(as_text(load_blob(blobs, blob)), "hello");
    });
}

TEST(DiskBlobs, neither_is_a_folder_of_blobs_whose_own_folder_cannot_be_synced) {
    test::as_plain_user([] {
        const TemporaryFolder folder;
        DiskBlobs blobs(folder.path());
        {
            const Unsyncable unsyncable(folder.path() / "blobs");
            EXPECT_THAT([&] { put(blobs, "hello"); },
                        fails_with(ErrorCode::storage_failed, "Permission denied"));
        }
        EXPECT_TRUE(std::filesystem::is_empty(folder.path() / "blobs"));
        EXPECT_EQ(as_text(load_blob(blobs, put(blobs, "hello"))), "hello");
    });
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
