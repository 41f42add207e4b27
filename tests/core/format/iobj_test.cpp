// Instanced OBJ, in and out.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>

#include "core/base/error.h"
#include "core/format/iobj/directive.h"
#include "core/format/obj/read_obj.h"
#include "core/format/obj/write_obj.h"
#include "core/scene/instance.h"

namespace coppice {
namespace {

using testing::HasSubstr;
using testing::Not;
using testing::StartsWith;

const std::string tree = "o tree\nv 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n";
const std::string identity = " 1 0 0 0  0 1 0 0  0 0 1 0  0 0 0 1";

Scene read(const std::string& text, const ReadLimits& limits = {}) {
    return read_obj(as_bytes(text), {}, limits, Watch{});
}

std::string written(const Scene& scene) {
    return std::string(as_text(write_iobj(scene, {.format = Format::iobj}, Watch{}).files.front().bytes));
}

Error refused(const std::string& text, const ReadLimits& limits = {}) {
    try {
        read(text, limits);
    } catch (const Error& error) {
        return error;
    }
    ADD_FAILURE() << "was read: " << text;
    return {ErrorCode::internal, "", ""};
}

TEST(Iobj, places_an_object_at_each_of_its_instance_lines) {
    const Scene scene =
        read("#@iobj 1.0\n" + tree + "#@instance tree oak-1  1 0 0 5  0 1 0 6  0 0 1 7  0 0 0 1\n" +
             "#@instance tree oak-2  0 -2 0 0  2 0 0 0  0 0 2 0  0 0 0 1\n");
    ASSERT_EQ(scene.meshes.size(), 1U);
    ASSERT_EQ(scene.nodes.size(), 2U);
    EXPECT_EQ(scene.nodes[0].name, "oak-1");
    EXPECT_EQ(scene.nodes[0].local.point({0, 0, 0}), (Vec3d{5, 6, 7}));
    EXPECT_EQ(scene.nodes[1].local.point({1, 0, 0}), (Vec3d{0, 2, 0}));
}

TEST(Iobj, places_an_object_without_instance_lines_once) {
    const Scene scene = read("#@iobj 1.0\n" + tree);
    ASSERT_EQ(scene.nodes.size(), 1U);
    EXPECT_EQ(scene.nodes[0].name, "tree");
    EXPECT_EQ(scene.nodes[0].local, Transform{});
}

TEST(Iobj, takes_directives_before_their_object) {
    EXPECT_EQ(
        read("#@iobj 1.0\n#@instance tree a" + identity + "\n#@instance tree b" + identity + "\n" + tree)
            .nodes.size(),
        2U);
}

TEST(Iobj, unquotes_names) {
    const Scene scene = read(
        "#@iobj 1.0\no a \"big\" tree\nv 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n"
        R"(#@instance "a \"big\" tree" "back\\slash")" +
        identity + "\n");
    ASSERT_EQ(scene.nodes.size(), 1U);
    EXPECT_EQ(scene.nodes[0].name, "back\\slash");
}

TEST(Iobj, is_a_comment_in_a_plain_obj) {
    const Scene scene = read(tree + "#@instance nothing here\n#@whatever\n");
    EXPECT_EQ(scene.nodes.size(), 1U);
}

TEST(Iobj, refuses_wrong_directives_and_names_their_line) {
    const std::string matrix_but_one = " 1 0 0 0  0 1 0 0  0 0 1 0  0 0 0";
    const std::vector<std::string> lines = {
        "#@instanced tree a" + identity,
        "#@",
        "#@instance",
        "#@instance tree",
        "#@instance tree a" + matrix_but_one,
        "#@instance tree a" + identity + " 1",
        "#@instance tree a" + matrix_but_one + " 2",
        "#@instance tree a" + matrix_but_one + " x",
        "#@instance tree a 1 0 0 nan 0 1 0 0 0 0 1 0 0 0 0 1",
        "#@instance tree a 1 0 0 0 0 1 0 0 0 0 0 0 0 0 0 1",
        "#@instance \"tree a" + identity,
        "#@instance shrub a" + identity,
        "#@iobj 1.0",
    };
    for (const std::string& line : lines) {
        const Error error = refused("#@iobj 1.0\n" + tree + line + "\n");
        EXPECT_EQ(error.code(), ErrorCode::asset_malformed) << line;
        EXPECT_THAT(error.where(), StartsWith("line 7")) << line;
    }
}

TEST(Iobj, refuses_other_versions) {
    for (const std::string version : {"2.0", "", "0.9", "1.x", "1.0 more"}) {
        const Error error = refused("#@iobj " + version + "\n" + tree);
        EXPECT_THAT(error.where(), StartsWith("line 1")) << version;
    }
    EXPECT_EQ(read("#@iobj 1.7\n" + tree).meshes.size(), 1U);
}

TEST(Iobj, refuses_two_objects_of_one_name) {
    EXPECT_THAT(refused("#@iobj 1.0\n" + tree + tree).where(), StartsWith("line 7"));
}

TEST(Iobj, counts_what_instances_draw_against_the_limit) {
    ReadLimits limits;
    limits.rendered_triangles = 1;
    const std::string text =
        "#@iobj 1.0\n" + tree + "#@instance tree a" + identity + "\n#@instance tree b" + identity + "\n";
    EXPECT_EQ(refused(text, limits).code(), ErrorCode::asset_too_large);
}

TEST(Iobj, writes_each_mesh_once_with_its_instances) {
    const std::string text = "#@iobj 1.0\n" + tree +
                             "#@instance tree oak-1 1 0 0 5  0 1 0 0.1  0 0 1 0  0 0 0 1\n" +
                             "#@instance tree \"second oak\" 2 0 0 0  0 2 0 0  0 0 2 0  0 0 0 1\n";
    EXPECT_EQ(written(read(text)), text);
}

TEST(Iobj, writes_no_directive_for_what_stands_once_at_the_identity) {
    EXPECT_EQ(written(read("#@iobj 1.0\n" + tree)), "#@iobj 1.0\n" + tree);
}

TEST(Iobj, makes_object_names_unique_and_leaves_out_meshes_that_stand_nowhere) {
    Scene scene = read("#@iobj 1.0\n" + tree);
    scene.meshes.push_back(scene.meshes[0]);
    scene.meshes.push_back(scene.meshes[0]);
    scene.nodes.push_back(scene.nodes[0]);
    scene.nodes.back().mesh = 2;
    scene.roots.push_back(1);
    const ObjFiles files = write_iobj(scene, {.format = Format::iobj}, Watch{});
    const std::string text(as_text(files.files.front().bytes));
    EXPECT_THAT(text, HasSubstr("o tree\n"));
    EXPECT_THAT(text, HasSubstr("o tree-3\n"));
    EXPECT_THAT(text, Not(HasSubstr("tree-2")));
    EXPECT_EQ(files.mesh_bytes[1], 0U);
    EXPECT_EQ(instances(read(text)).size(), 2U);
}

}  // namespace
}  // namespace coppice
