#include "core/format/detect.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>

#include "core/base/error.h"

namespace coppice {
namespace {

using namespace std::string_literals;
using namespace std::string_view_literals;
using testing::HasSubstr;

const std::string triangle = "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n";
constexpr std::string_view glb_2 = "glTF\x02\0\0\0\x0c\0\0\0"sv;
constexpr std::string_view gltf_2 =
    R"({"scenes": [{"asset": {"version": "9"}}], "asset": {"version": "2.0"}})";

Format detected(std::string_view content, std::string_view type = "", std::string_view name = "") {
    return detect(as_bytes(content), told_media_type(type), name);
}

Error refused(std::string_view content, std::string_view type = "", std::string_view name = "") {
    try {
        detected(content, type, name);
    } catch (const Error& error) {
        return error;
    }
    ADD_FAILURE() << "was recognised: " << content;
    return {ErrorCode::internal, "", ""};
}

TEST(Detect, recognises_every_format_by_its_content) {
    EXPECT_EQ(detected(glb_2), Format::glb);
    EXPECT_EQ(detected(gltf_2), Format::gltf);
    EXPECT_EQ(detected("\xef\xbb\xbf \n{\"asset\":{\"extras\":{\"version\":\"1.0\"},\"version\":\"2.0\"}}"),
              Format::gltf);
    EXPECT_EQ(detected(triangle), Format::obj);
    EXPECT_EQ(detected("# made by hand\nmtllib a.mtl\n" + triangle), Format::obj);
    EXPECT_EQ(detected("#@iobj 1.0\n" + triangle), Format::iobj);
    EXPECT_EQ(detected("ply\nformat ascii 1.0\n"), Format::ply);
    EXPECT_EQ(detected("ply\r\nformat ascii 1.0\r\n"), Format::ply);
    EXPECT_EQ(detected("solid cube\n facet normal 0 0 1\n"), Format::stl);
    EXPECT_EQ(detected("solid, yet binary" + std::string(63, ' ') + "\x01\0\0\0"s + std::string(50, '\0')),
              Format::stl);
}

TEST(Detect, recognises_an_obj_with_words_that_it_does_not_know) {
    EXPECT_EQ(detected("# subdivision\n" + triangle + "t crease 2/1/0 1 2 4.5\n"), Format::obj);
    EXPECT_EQ(detected("ctech cubic\nv -1 0 .5\nvn 0 1 0\n"), Format::obj);
    EXPECT_EQ(detected("tool 7\nv 0 0 0 1\nf 1/1/1 -2//3 3\n"), Format::obj);
    for (const char* other : {"v 0 0 0\nx 1 2 3\n", "about v\nv of a vertex\nf of a face\n", "t 1 2\n",
                              "hello\nv 1 2\nf 1 2\nvn 1 2\n", "hello\nf a/b c d\nf 1 2 x\n"}) {
        EXPECT_EQ(refused(other).code(), ErrorCode::asset_unsupported) << other;
    }
}

TEST(Detect, says_how_to_tell_a_format_that_its_content_does_not) {
    EXPECT_THAT(refused("nothing known").message(), HasSubstr("Content-Type"));
    EXPECT_THAT(refused("nothing known").message(), HasSubstr("model/obj"));
}

TEST(Detect, takes_media_types_that_say_nothing_as_not_given) {
    for (const char* type :
         {"", "application/octet-stream", "application/x-www-form-urlencoded", "text/plain; charset=utf-8"}) {
        EXPECT_EQ(detected(triangle, type), Format::obj) << type;
    }
}

TEST(Detect, agrees_with_a_media_type_of_any_case_and_parameters) {
    EXPECT_EQ(detected(glb_2, "Model/glTF-Binary; q=1"), Format::glb);
}

TEST(Detect, lets_an_instanced_obj_be_called_obj_but_not_the_reverse) {
    EXPECT_EQ(detected("#@iobj 1.0\n" + triangle, "model/obj", "a.obj"), Format::iobj);
    EXPECT_EQ(refused(triangle, "model/vnd.coppice.iobj").code(), ErrorCode::asset_format_mismatch);
}

TEST(Detect, says_both_where_content_and_type_contradict_each_other) {
    const Error by_type = refused(glb_2, "model/obj");
    EXPECT_EQ(by_type.code(), ErrorCode::asset_format_mismatch);
    EXPECT_THAT(by_type.message(), HasSubstr("glb"));
    EXPECT_THAT(by_type.message(), HasSubstr("model/obj"));
    EXPECT_EQ(refused(glb_2, "image/png").code(), ErrorCode::asset_format_mismatch);
    EXPECT_THAT(refused(triangle, "", "scene.ply").message(), HasSubstr("scene.ply"));
}

TEST(Detect, ignores_file_names_that_tell_no_format) {
    EXPECT_EQ(detected(triangle, "", "upload.bin"), Format::obj);
}

TEST(Detect, falls_back_to_type_and_then_name_where_content_tells_nothing) {
    EXPECT_EQ(detected("nothing known", "model/obj"), Format::obj);
    EXPECT_EQ(detected("nothing known", "", "a.OBJ"), Format::obj);
    EXPECT_EQ(refused("nothing known", "model/obj", "a.stl").code(), ErrorCode::asset_format_mismatch);
    EXPECT_EQ(refused("nothing known").code(), ErrorCode::asset_unsupported);
    EXPECT_EQ(refused("nothing known", "video/mp4", "a.obj").code(), ErrorCode::asset_unsupported);
}

TEST(Detect, says_that_it_is_empty) {
    EXPECT_EQ(refused("").code(), ErrorCode::asset_empty);
}

TEST(Detect, names_what_is_not_read) {
    const std::vector<std::pair<std::string_view, std::string>> known = {
        {"i3dm\x01\0\0\0"sv, "i3dm"},
        {"b3dm\x01\0\0\0"sv, "b3dm"},
        {"glTF\x01\0\0\0\x14\0\0\0"sv, "glTF 1.0"},
        {R"({"asset":{"version":"1.0"}})", "glTF 1.0"},
        {R"({"asset":{"version":"3.0"}})", "asset.version \"3.0\" (later than glTF 2.0)"},
        {R"({"asset":{"version":"20"}})", "asset.version \"20\" (no version of glTF)"},
        {"Kaydara FBX Binary  \0"sv, "FBX"},
        {"<?xml version=\"1.0\"?>\n<COLLADA xmlns=\"\">", "COLLADA"},
        {"MM\x0c\0\0\0......"sv, "3DS"},
        {"OFF\n8 6 0\n", "OFF"},
        {"\x89PNG\r\n\x1a\n"sv, "image/png"},
        {"<!DOCTYPE html><html>", "HTML"},
        {"\x1f\x8b\x08"sv, "gzip"},
    };
    for (const auto& [content, what] : known) {
        const Error error = refused(content, "model/gltf-binary", "a.glb");
        EXPECT_EQ(error.code(), ErrorCode::asset_unsupported) << what;
        EXPECT_THAT(error.message(), HasSubstr(what));
        EXPECT_THAT(error.message(), HasSubstr("OBJ"));
    }
}

TEST(Detect, survives_json_that_never_ends) {
    EXPECT_EQ(recognise(as_bytes(std::string(1 << 20, '{'))).format, std::nullopt);
    EXPECT_EQ(recognise(as_bytes("{\"asset\":{\"version\":\"2.0")).format, Format::gltf);
    EXPECT_EQ(recognise(as_bytes("{\"asset\":{\"version\":\"\\")).format, std::nullopt);
}

}  // namespace
}  // namespace coppice
