#include "server/http/multipart.h"

#include <gtest/gtest.h>

#include "tests/server/fails_with.h"
#include "tests/server/http_client.h"

namespace coppice {
namespace {

using test::fails_with;

// Gives a text, `step` bytes at a time.
class TextBody final : public Body {
  public:
    TextBody(std::string text, size_t step) : text_(std::move(text)), step_(step) {}

    size_t read(std::span<std::byte> into) override {
        const size_t given = std::min({into.size(), step_, text_.size() - offset_});
        std::copy_n(as_bytes(text_).begin() + static_cast<ptrdiff_t>(offset_), given, into.begin());
        offset_ += given;
        return given;
    }

  private:
    std::string text_;
    size_t step_;
    size_t offset_ = 0;
};

struct ReadPart {
    Part part;
    std::string content;
};

std::vector<ReadPart> read_parts(const std::string& body_text, size_t step = 7,
                                 const HttpLimits& limits = {}) {
    TextBody body(body_text, step);
    MultipartReader reader(body, "multipart/form-data; boundary=XyZ", limits);
    std::vector<ReadPart> parts;
    while (auto part = reader.next()) {
        Bytes some(10);
        Bytes all;
        while (const size_t got = reader.read(some)) append(all, ByteView(some).first(got));
        parts.push_back({*part, std::string(as_text(all))});
    }
    return parts;
}

TEST(Multipart, parts_come_out_as_they_went_in_however_the_bytes_arrive) {
    const std::string tricky = "a\r\n--Xy\r\n--XyY\r\n-\r\n";
    const std::string body =
        test::multipart(
            {{"asset", tricky, "scene.glb", "model/gltf-binary"}, {"options", "{}"}, {"resource", "", "x"}})
            .second;
    for (size_t step = 1; step < 80; ++step) {
        const auto parts = read_parts(body, step);
        ASSERT_EQ(parts.size(), 3U) << step;
        EXPECT_EQ(parts[0].part.name, "asset");
        EXPECT_EQ(parts[0].part.file_name, "scene.glb");
        EXPECT_EQ(parts[0].part.media_type, "model/gltf-binary");
        EXPECT_EQ(parts[0].content, tricky);
        EXPECT_EQ(parts[1].content, "{}");
        EXPECT_EQ(parts[1].part.media_type, "");
        EXPECT_EQ(parts[2].content, "");
    }
}

TEST(Multipart, preamble_and_epilogue_are_skipped) {
    const auto parts =
        read_parts("hello\r\n--XyZ \r\nContent-Disposition: form-data; name=a\r\n\r\n1\r\n--XyZ--\r\nbye");
    ASSERT_EQ(parts.size(), 1U);
    EXPECT_EQ(parts[0].content, "1");
}

TEST(Multipart, quoted_names_may_hold_semicolons_and_escaped_quotes) {
    const auto parts = read_parts(
        "--XyZ\r\ncontent-disposition: form-data; name=\"re;source\"; "
        "filename=\"a\\\"b.png\"\r\n\r\n1\r\n--XyZ--");
    EXPECT_EQ(parts.at(0).part.name, "re;source");
    EXPECT_EQ(parts.at(0).part.file_name, "a\"b.png");
}

TEST(Multipart, a_part_that_nobody_reads_is_skipped) {
    TextBody body(test::multipart({{"a", std::string(1000, 'x')}, {"b", "2"}}).second, 100);
    const HttpLimits limits;
    MultipartReader reader(body, "multipart/form-data; boundary=\"XyZ\"", limits);
    EXPECT_EQ(reader.next()->name, "a");
    EXPECT_EQ(reader.next()->name, "b");
    EXPECT_FALSE(reader.next());
}

TEST(Multipart, what_is_not_well_formed_is_refused) {
    for (const std::string body :
         {"", "nothing", "--XyZ", "--XyZ\r\n",
          "--XyZ\r\nContent-Disposition: form-data; name=a\r\n\r\nno end",
          "--XyZ\r\nContent-Disposition: form-data\r\n\r\n1\r\n--XyZ--", "--XyZ\r\n\r\n1\r\n--XyZ--",
          "--XyZ\r\nno colon\r\n\r\n1\r\n--XyZ--",
          "--XyZfoo\r\nContent-Disposition: form-data; name=a\r\n\r\n1\r\n--XyZ--"}) {
        EXPECT_THAT([&] { read_parts(body); }, fails_with(ErrorCode::request_malformed, "")) << body;
    }
    TextBody body("", 1);
    const HttpLimits limits;
    EXPECT_THAT([&] { MultipartReader(body, "multipart/form-data", limits); },
                fails_with(ErrorCode::request_malformed, "boundary"));
}

TEST(Multipart, headers_and_parts_are_limited) {
    HttpLimits limits;
    limits.parts = 2;
    const std::string three = test::multipart({{"a", "1"}, {"b", "2"}, {"c", "3"}}).second;
    EXPECT_THAT([&] { read_parts(three, 100, limits); },
                fails_with(ErrorCode::request_malformed, "http_parts"));
    const std::string endless = "--XyZ\r\nX: " + std::string(1 << 20, 'x');
    EXPECT_THAT([&] { read_parts(endless, 1000); },
                fails_with(ErrorCode::request_malformed, "http_part_header_bytes"));
}

}  // namespace
}  // namespace coppice
