#include "core/format/asset.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>

#include "core/base/error.h"
#include "core/format/archive.h"

namespace coppice {
namespace {

using testing::HasSubstr;

const std::string triangle = "mtllib m.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nusemtl red\nf 1 2 3\n";
const std::string library = "newmtl red\nmap_Kd red.png\n";

ReadAsset read(const Bytes& bytes, const std::string& type = "", const std::string& entry = "",
               std::vector<UploadedFile> resources = {}) {
    return read_asset({.asset = {.path = "", .media_type = type, .bytes = bytes},
                       .resources = std::move(resources),
                       .entry = entry},
                      {}, Watch{});
}

Error refused(const Bytes& bytes, const std::string& type = "", const std::string& entry = "") {
    try {
        read(bytes, type, entry);
    } catch (const Error& error) {
        return error;
    }
    ADD_FAILURE() << "was read";
    return {ErrorCode::internal, "", ""};
}

Bytes zipped(const std::vector<std::pair<std::string, std::string>>& files) {
    std::vector<NamedFile> named;
    for (const auto& [path, text] : files) named.push_back({path, to_bytes(text)});
    return write_zip(named, Watch{});
}

TEST(Asset, is_read_with_resources_that_came_as_parts) {
    const ReadAsset asset = read(to_bytes(triangle), "model/obj", "",
                                 {{"C:\\x\\m.mtl", "", as_bytes(library)}, {"red.png", "", as_bytes("png")}});
    EXPECT_EQ(asset.format, Format::obj);
    EXPECT_EQ(asset.scene.images.size(), 1U);
}

TEST(Asset, names_the_parts_that_nothing_in_it_uses) {
    const std::vector<UploadedFile> parts = {{"m.mtl", "", as_bytes(library)},
                                             {"red.png", "", as_bytes("png")},
                                             {"docs/README.md", "", as_bytes("hello")}};
    const Bytes zip = zipped({{"a.obj", triangle}, {"notes.txt", "of a zip, which may hold anything"}});
    for (const Bytes& asset : {to_bytes(triangle), zip}) {
        const std::vector<Warning> warnings = read(asset, "", "", parts).scene.warnings;
        ASSERT_EQ(warnings.size(), 1U);
        EXPECT_EQ(warnings[0].code, "resource.unused");
        EXPECT_EQ(warnings[0].where, "docs/README.md");
        EXPECT_THAT(warnings[0].message, HasSubstr("\"docs/README.md\""));
    }
}

TEST(Asset, loses_triangles_without_area_and_second_ones_and_says_so) {
    const Scene scene =
        read(to_bytes("v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nf 1 2 3\nf 2 3 1\nf 1 1 2\nf 1 3 4\n")).scene;
    EXPECT_EQ(scene.meshes[0].triangle_count(), 2U);
    ASSERT_EQ(scene.warnings.size(), 2U);
    EXPECT_EQ(scene.warnings[0].code, "repair.degenerate_triangles");
    EXPECT_EQ(scene.warnings[1].code, "repair.duplicate_triangles");
}

TEST(Asset, is_found_in_a_zip_nearest_to_the_root_with_its_own_folder) {
    const Bytes zip = zipped({{"readme.txt", "hello"},
                              {"scene/lods/low.obj", triangle},
                              {"scene/high.obj", triangle},
                              {"scene/m.mtl", library},
                              {"scene/red.png", "right"},
                              {"other/red.png", "wrong"}});
    for (const char* type : {"application/zip", "model/obj", ""}) {
        const ReadAsset asset = read(zip, type);
        ASSERT_EQ(asset.scene.images.size(), 1U) << type;
        EXPECT_EQ(as_text(asset.scene.images[0].bytes), "right");
    }
}

TEST(Asset, is_chosen_by_entry_where_a_zip_has_several) {
    const Bytes zip = zipped({{"a.obj", triangle}, {"b.obj", triangle + "f 1 3 2\n"}});
    const Error error = refused(zip);
    EXPECT_EQ(error.code(), ErrorCode::asset_ambiguous);
    EXPECT_THAT(error.message(), HasSubstr("\"a.obj\", \"b.obj\""));
    EXPECT_EQ(read(zip, "", "b.obj").scene.meshes[0].triangle_count(), 2U);
    EXPECT_EQ(refused(zip, "", "c.obj").code(), ErrorCode::option_invalid);
    EXPECT_EQ(refused(to_bytes(triangle), "", "a.obj").code(), ErrorCode::option_invalid);
}

TEST(Asset, is_no_zip_in_a_zip) {
    const std::string inner(as_text(zipped({{"a.obj", triangle}})));
    EXPECT_EQ(refused(zipped({{"a.obj", inner}})).code(), ErrorCode::asset_unsupported);
    EXPECT_EQ(refused(zipped({{"a.zip", inner}})).code(), ErrorCode::asset_unsupported);
    EXPECT_EQ(refused(to_bytes("PK\x05\x06" + std::string(18, '\0'))).code(), ErrorCode::asset_unsupported);
}

TEST(Asset, contradicts_a_zip_type_that_is_none) {
    EXPECT_EQ(refused(to_bytes(triangle), "application/zip").code(), ErrorCode::asset_format_mismatch);
    EXPECT_EQ(refused({}, "application/zip").code(), ErrorCode::asset_empty);
}

TEST(Asset, leaves_as_a_zip_exactly_when_files_go_along) {
    const ReadAsset alone = read(to_bytes("v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n"));
    const WrittenAsset text = write_asset(alone.scene, {.format = Format::iobj}, Watch{});
    EXPECT_EQ(text.media_type, "model/vnd.coppice.iobj");
    EXPECT_EQ(text.file_extension, "iobj");
    const ReadAsset with_library = read(to_bytes(triangle), "", "", {{"m.mtl", "", as_bytes(library)}});
    const WrittenAsset zip = write_asset(with_library.scene, {.format = Format::obj}, Watch{});
    EXPECT_EQ(zip.media_type, "application/zip");
    EXPECT_EQ(zip.file_extension, "zip");
    EXPECT_EQ(read(zip.bytes).format, Format::obj);
}

TEST(Asset, refuses_instancing_that_its_format_cannot_hold) {
    const ReadAsset asset = read(to_bytes(triangle));
    for (const auto& [format, instancing] :
         {std::pair(Format::obj, Instancing::nodes), std::pair(Format::iobj, Instancing::expand)}) {
        try {
            write_asset(asset.scene, {.format = format, .instancing = instancing}, Watch{});
            ADD_FAILURE() << id(format);
        } catch (const Error& error) {
            EXPECT_EQ(error.code(), ErrorCode::option_conflict);
        }
    }
    EXPECT_THROW(write_asset(asset.scene, {.format = Format::ply}, Watch{}), Error);
}

}  // namespace
}  // namespace coppice
