#include "core/format/archive.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <zip.h>

#include <string>

#include "core/base/error.h"
#include "tests/core/format/trip_wire.h"

namespace coppice {
namespace {

using testing::HasSubstr;

const std::vector<NamedFile> two_files = {{"scene.obj", to_bytes("v 0 0 0\n")},
                                          {"textures/a.png", to_bytes("pixels")}};

Error refused(ByteView zip, const ReadLimits& limits = {}) {
    try {
        read_zip(zip, limits, Watch{});
    } catch (const Error& error) {
        return error;
    }
    ADD_FAILURE() << "was read";
    return {ErrorCode::internal, "", ""};
}

// Each byte string of that length that occurs is replaced: entry names stand in two places.
Bytes with_replaced(Bytes bytes, std::string_view what, std::string_view by) {
    std::string text(as_text(bytes));
    EXPECT_EQ(what.size(), by.size());
    for (size_t at = text.find(what); at != text.npos; at = text.find(what, at + 1))
        text.replace(at, by.size(), by);
    return to_bytes(text);
}

void put_u32(Bytes& bytes, size_t at, uint32_t value) {
    for (size_t i = 0; i < 4; ++i) bytes[at + i] = static_cast<std::byte>(value >> (8 * i));
}

std::vector<size_t> directory_entries(const Bytes& zip) {
    std::vector<size_t> entries;
    const std::string_view text = as_text(zip);
    for (size_t at = text.find("PK\x01\x02"); at != text.npos; at = text.find("PK\x01\x02", at + 4))
        entries.push_back(at);
    return entries;
}

TEST(Zip, gives_back_the_files_that_were_written) {
    const auto files = read_zip(write_zip(two_files, Watch{}), {}, Watch{});
    ASSERT_EQ(files.size(), 2U);
    EXPECT_EQ(files[1].path, "textures/a.png");
    EXPECT_EQ(files[1].bytes, two_files[1].bytes);
}

TEST(Zip, stops_packing_when_it_is_told_to_in_the_midst_of_a_file) {
    const std::vector<NamedFile> files = {{"zeros.bin", Bytes(32 << 20)}};
    const ByteView bytes = files[0].bytes;
    std::stop_source source;
    const test::TripWire middle(bytes, bytes.size() / 2, [&] { source.request_stop(); });
    const test::TripWire end(bytes, bytes.size() - (1 << 20));
    EXPECT_THROW(write_zip(files, {.stop = source.get_token()}), Error);
    EXPECT_TRUE(middle.was_touched());
    EXPECT_FALSE(end.was_touched()) << "it went on";
}

TEST(Zip, packs_to_the_end_otherwise) {
    const std::vector<NamedFile> files = {{"zeros.bin", Bytes(32 << 20)}};
    const test::TripWire end(files[0].bytes, files[0].bytes.size() - (1 << 20));
    write_zip(files, Watch{});
    EXPECT_TRUE(end.was_touched());
}

TEST(Zip, writes_the_same_bytes_again) {
    EXPECT_EQ(write_zip(two_files, Watch{}), write_zip(two_files, Watch{}));
}

TEST(Zip, packs_text_and_stores_images) {
    const std::string text(10000, 'x');
    EXPECT_LT(write_zip({{"a.txt", to_bytes(text)}}, Watch{}).size(), 500U);
    EXPECT_GT(write_zip({{"a.jpg", to_bytes("\xff\xd8\xff" + text)}}, Watch{}).size(), 10000U);
}

TEST(Zip, leaves_out_what_macos_adds) {
    const Bytes zip =
        write_zip({{"a.obj", to_bytes("x")}, {"__MACOSX/._a.obj", to_bytes("y")}, {"._b", {}}}, Watch{});
    EXPECT_EQ(read_zip(zip, {}, Watch{}).size(), 1U);
}

TEST(Zip, refuses_paths_that_leave_it) {
    const Bytes zip = write_zip({{"xx/evil.obj", to_bytes("v")}}, Watch{});
    for (const std::string_view path : {"../evil.obj", "/x/evil.obj", "x\\/evil.obj", "c:/evil.obj"}) {
        EXPECT_EQ(refused(with_replaced(zip, "xx/evil.obj", path)).code(), ErrorCode::resource_forbidden)
            << path;
    }
}

TEST(Zip, refuses_the_same_name_twice) {
    const Bytes zip = write_zip({{"a.obj", to_bytes("1")}, {"b.obj", to_bytes("2")}}, Watch{});
    EXPECT_EQ(refused(with_replaced(zip, "b.obj", "a.obj")).code(), ErrorCode::asset_malformed);
}

TEST(Zip, refuses_more_entries_than_the_limit) {
    ReadLimits limits;
    limits.zip_entries = 1;
    const Error error = refused(write_zip(two_files, Watch{}), limits);
    EXPECT_EQ(error.code(), ErrorCode::asset_too_large);
    EXPECT_THAT(error.message(), HasSubstr("zip_entries"));
}

TEST(Zip, refuses_a_bomb_by_its_ratio) {
    const Bytes zip = write_zip({{"zeros", Bytes(8 << 20)}}, Watch{});
    const Error error = refused(zip);
    EXPECT_EQ(error.code(), ErrorCode::asset_too_large);
    EXPECT_THAT(error.message(), HasSubstr("zip_ratio"));
}

TEST(Zip, refuses_more_unpacked_bytes_than_the_limit) {
    ReadLimits limits;
    limits.zip_bytes = 10;
    EXPECT_THAT(refused(write_zip(two_files, Watch{}), limits).message(), HasSubstr("zip_bytes"));
}

TEST(Zip, refuses_an_entry_that_lies_about_its_size) {
    const std::string text(100000, 'x');
    Bytes zip = write_zip({{"a.txt", to_bytes(text)}}, Watch{});
    const size_t entry = directory_entries(zip).front();
    const uint32_t local = load_u32(zip, entry + 42);
    put_u32(zip, entry + 24, 10);
    put_u32(zip, local + 22, 10);
    EXPECT_EQ(refused(zip).code(), ErrorCode::asset_malformed);
}

TEST(Zip, refuses_entries_that_overlap) {
    Bytes zip = write_zip({{"a.obj", to_bytes("same")}, {"b.obj", to_bytes("same")}}, Watch{});
    const auto entries = directory_entries(zip);
    put_u32(zip, entries[1] + 42, load_u32(zip, entries[0] + 42));
    EXPECT_EQ(refused(zip).code(), ErrorCode::asset_malformed);
}

TEST(Zip, refuses_links) {
    Bytes zip = write_zip({{"a.obj", to_bytes("/etc/passwd")}}, Watch{});
    const size_t entry = directory_entries(zip).front();
    zip[entry + 5] = std::byte{ZIP_OPSYS_UNIX};
    put_u32(zip, entry + 38, 0120777U << 16);
    const Error error = refused(zip);
    EXPECT_EQ(error.code(), ErrorCode::resource_forbidden);
    EXPECT_THAT(error.message(), HasSubstr("link"));
}

TEST(Zip, refuses_encrypted_entries) {
    Bytes zip = write_zip({{"a.obj", to_bytes("secret")}}, Watch{});
    const size_t entry = directory_entries(zip).front();
    zip[entry + 8] |= std::byte{1};
    zip[load_u32(zip, entry + 42) + 6] |= std::byte{1};
    EXPECT_EQ(refused(zip).code(), ErrorCode::asset_unsupported);
}

TEST(Zip, refuses_every_truncation_and_survives_every_flipped_byte) {
    const Bytes zip = write_zip(two_files, Watch{});
    for (size_t size = 0; size < zip.size(); ++size) {
        EXPECT_THROW(read_zip(ByteView(zip).first(size), {}, Watch{}), Error) << size;
    }
    for (size_t at = 0; at < zip.size(); ++at) {
        for (const int flip : {0x01, 0x80, 0xff}) {
            Bytes broken = zip;
            broken[at] ^= static_cast<std::byte>(flip);
            try {
                read_zip(broken, {}, Watch{});
            } catch (const Error&) {
            }
        }
    }
}

}  // namespace
}  // namespace coppice
