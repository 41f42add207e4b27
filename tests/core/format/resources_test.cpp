#include "core/format/resources.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>

#include "core/base/error.h"

namespace coppice {
namespace {

using namespace std::string_view_literals;
using testing::HasSubstr;

std::string found(const Resources& resources, std::string_view uri) {
    return std::string(as_text(resources.find(uri, "/images/0")));
}

Error refused(const Resources& resources, std::string_view uri) {
    try {
        resources.find(uri, "/images/0/uri");
    } catch (const Error& error) {
        return error;
    }
    ADD_FAILURE() << "was found: " << uri;
    return {ErrorCode::internal, "", ""};
}

TEST(Resources, finds_the_exact_path_before_the_base_name) {
    const Resources resources({{"b/tree.png", as_bytes("wrong")}, {"a/tree.png", as_bytes("right")}});
    EXPECT_EQ(found(resources, "a/tree.png"), "right");
    EXPECT_EQ(found(resources, "./a//tree.png"), "right");
}

TEST(Resources, finds_a_base_name_that_is_unique) {
    const Resources resources({{"tree.png", as_bytes("tree")}});
    EXPECT_EQ(found(resources, "textures/tree.png"), "tree");
}

TEST(Resources, does_not_guess_between_two_of_one_base_name) {
    const Resources resources({{"a/tree.png", as_bytes("a")}, {"b/tree.png", as_bytes("b")}});
    EXPECT_EQ(refused(resources, "tree.png").code(), ErrorCode::resource_missing);
}

TEST(Resources, resolves_from_the_folder_of_the_asset) {
    const Resources resources({{"x/t.png", as_bytes("x")}, {"y/t.png", as_bytes("y")}}, "y");
    EXPECT_EQ(found(resources, "t.png"), "y");
}

TEST(Resources, decodes_percent_escapes_once) {
    const Resources resources({{"a b.png", as_bytes("blank")}, {"%61.png", as_bytes("literal")}});
    EXPECT_EQ(found(resources, "a%20b.png"), "blank");
    EXPECT_EQ(found(resources, "%2561.png"), "literal");
}

TEST(Resources, says_what_is_missing_and_what_is_there) {
    const Error error = refused(Resources({{"a.png", ByteView{}}}), "b.png");
    EXPECT_EQ(error.code(), ErrorCode::resource_missing);
    EXPECT_EQ(error.where(), "/images/0/uri");
    EXPECT_THAT(error.message(), HasSubstr("\"b.png\""));
    EXPECT_THAT(error.message(), HasSubstr("a.png"));
}

TEST(Resources, refuses_every_way_out_of_the_upload) {
    const Resources resources({{"passwd", as_bytes("harmless")}});
    for (const std::string_view uri :
         {"../passwd", "a/../../passwd", "/etc/passwd", "//host/passwd", "%2e%2e/passwd", "%2e%2e%2fpasswd",
          "..", "file:///etc/passwd", "http://host/passwd", "C:/passwd", "c%3A/passwd", "..\\passwd",
          "a\\passwd", "%5c%5chost%5cpasswd", "passwd%00.png", "%", "%zz", "%2", ""}) {
        EXPECT_EQ(refused(resources, uri).code(), ErrorCode::resource_forbidden) << uri;
    }
}

TEST(Resources, lets_dots_be_part_of_names) {
    const Resources resources({{"a..b/...png", as_bytes("dots")}});
    EXPECT_EQ(found(resources, "a..b/...png"), "dots");
}

TEST(Resources, tells_images_by_their_first_bytes) {
    EXPECT_EQ(image_mime_type(as_bytes("\x89PNG\r\n\x1a\n...."sv)), "image/png");
    EXPECT_EQ(image_mime_type(as_bytes("\xff\xd8\xff\xe0"sv)), "image/jpeg");
    EXPECT_EQ(image_mime_type(as_bytes("RIFF....WEBPVP8 "sv)), "image/webp");
    EXPECT_EQ(image_mime_type(as_bytes("RIFF....WAVE"sv)), "");
    EXPECT_EQ(image_mime_type({}), "");
}

}  // namespace
}  // namespace coppice
