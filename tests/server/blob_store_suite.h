// What every blob store keeps. A store's test file instantiates it:
//   INSTANTIATE_TEST_SUITE_P(Disk, BlobStoreSuite, ::testing::Values(BlobStoreFactory{...}));
#pragma once

#include <gtest/gtest.h>

#include <functional>
#include <memory>
#include <ostream>
#include <string>
#include <thread>

#include "core/base/hash.h"
#include "server/blobs/blob_store.h"
#include "tests/server/fails_with.h"

namespace coppice::test {

// make() gives a new, empty store; whatever it needs to live in is gone with it.
struct BlobStoreFactory {
    std::string name;
    std::function<std::shared_ptr<BlobStore>()> make;

    friend std::ostream& operator<<(std::ostream& out, const BlobStoreFactory& factory) {
        return out << factory.name;
    }
};

class BlobStoreSuite : public ::testing::TestWithParam<BlobStoreFactory> {
  protected:
    BlobRef put(std::string_view text) {
        const auto writer = store->create();
        writer->write(as_bytes(text));
        return writer->commit();
    }

    std::shared_ptr<BlobStore> store = GetParam().make();
    static bool nobody_needs_it() { return false; }
};

TEST_P(BlobStoreSuite, gives_back_what_was_put_in_under_its_hash) {
    const BlobRef blob = put("hello");
    EXPECT_EQ(blob.sha256, sha256_hex(as_bytes("hello")));
    EXPECT_EQ(blob.bytes, 5U);
    EXPECT_EQ(as_text(load_blob(*store, blob)), "hello");
}

TEST_P(BlobStoreSuite, takes_bytes_in_pieces_and_none_at_all) {
    const auto writer = store->create();
    for (int i = 0; i < 1000; ++i) writer->write(as_bytes("0123456789"));
    EXPECT_EQ(writer->commit().bytes, 10'000U);
    EXPECT_EQ(put("").bytes, 0U);
}

TEST_P(BlobStoreSuite, reads_any_part_and_stops_at_the_end) {
    const auto reader = store->open(put("0123456789").sha256);
    Bytes some(4);
    EXPECT_EQ(reader->read(3, some), 4U);
    EXPECT_EQ(as_text(some), "3456");
    EXPECT_EQ(reader->read(8, some), 2U);
    EXPECT_EQ(reader->read(10, some), 0U);
}

TEST_P(BlobStoreSuite, the_same_bytes_are_one_blob) {
    EXPECT_EQ(put("twice"), put("twice"));
    EXPECT_EQ(store->list().size(), 1U);
}

TEST_P(BlobStoreSuite, what_is_not_committed_leaves_nothing) {
    store->create()->write(as_bytes("half"));
    EXPECT_TRUE(store->list().empty());
    EXPECT_EQ(store->open(sha256_hex(as_bytes("half"))), nullptr);
}

TEST_P(BlobStoreSuite, what_is_not_there_is_null_whatever_it_is_called) {
    EXPECT_EQ(store->open(sha256_hex(as_bytes("never"))), nullptr);
    EXPECT_EQ(store->open("../../../../etc/passwd"), nullptr);
    EXPECT_EQ(store->open(""), nullptr);
    EXPECT_THAT(
        [&] {
            load_blob(*store, {sha256_hex(as_bytes("never")), 5});
        },
        fails_with(ErrorCode::storage_failed, "not there"));
}

TEST_P(BlobStoreSuite, an_open_blob_stays_readable_though_it_is_removed) {
    const BlobRef blob = put("hello");
    const auto reader = store->open(blob.sha256);
    EXPECT_TRUE(store->remove(blob.sha256, nobody_needs_it));
    EXPECT_EQ(store->open(blob.sha256), nullptr);
    Bytes all(5);
    EXPECT_EQ(reader->read(0, all), 5U);
    EXPECT_EQ(as_text(all), "hello");
}

TEST_P(BlobStoreSuite, removing_twice_is_no_error) {
    const BlobRef blob = put("hello");
    EXPECT_TRUE(store->remove(blob.sha256, nobody_needs_it));
    EXPECT_TRUE(store->remove(blob.sha256, nobody_needs_it));
}

TEST_P(BlobStoreSuite, what_is_needed_is_not_removed) {
    const BlobRef blob = put("hello");
    EXPECT_FALSE(store->remove(blob.sha256, [] { return true; }));
    EXPECT_NE(store->open(blob.sha256), nullptr);
}

TEST_P(BlobStoreSuite, what_a_writer_has_just_committed_is_not_removed_before_the_writer_lets_go) {
    auto writer = store->create();
    writer->write(as_bytes("hello"));
    const BlobRef blob = writer->commit();
    put("hello");  // another writer of the same bytes comes and goes
    EXPECT_FALSE(store->remove(blob.sha256, nobody_needs_it));
    writer.reset();
    EXPECT_TRUE(store->remove(blob.sha256, nobody_needs_it));
}

TEST_P(BlobStoreSuite, writers_of_the_same_and_of_different_bytes_work_at_the_same_time) {
    std::vector<std::thread> threads;
    for (int i = 0; i < 8; ++i) {
        threads.emplace_back([this, i] {
            for (int k = 0; k < 5; ++k) put("bytes " + std::to_string(i % 4) + std::to_string(k));
        });
    }
    for (std::thread& thread : threads) thread.join();
    EXPECT_EQ(store->list().size(), 20U);
}

TEST_P(BlobStoreSuite, says_that_it_is_writable) {
    EXPECT_NO_THROW(store->check_writable());
    EXPECT_TRUE(store->list().empty());
}

}  // namespace coppice::test
