#include "core/format/obj/read_obj.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>

#include "core/base/error.h"

namespace coppice {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

const std::string square = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\n";

Scene read(const std::string& text, const Resources& resources = {}, const ReadLimits& limits = {}) {
    Scene scene = read_obj(as_bytes(text), resources, limits, Watch{});
    for (const Mesh& mesh : scene.meshes) EXPECT_TRUE(is_consistent(mesh)) << mesh.name;
    return scene;
}

Error refused(const std::string& text, const ReadLimits& limits = {}) {
    try {
        read(text, {}, limits);
    } catch (const Error& error) {
        return error;
    }
    ADD_FAILURE() << "was read: " << text;
    return {ErrorCode::internal, "", ""};
}

std::vector<std::string> warning_codes(const Scene& scene) {
    std::vector<std::string> codes;
    for (const Warning& warning : scene.warnings) codes.push_back(warning.code);
    return codes;
}

TEST(ObjRead, makes_one_mesh_and_one_node_for_each_object) {
    const Scene scene = read(square + "o left\nf 1 2 3\no right\nf 1 3 4\n");
    ASSERT_EQ(scene.meshes.size(), 2U);
    EXPECT_EQ(scene.meshes[1].name, "right");
    EXPECT_EQ(scene.meshes[1].vertex_count(), 3U);
    ASSERT_EQ(scene.nodes.size(), 2U);
    EXPECT_EQ(scene.nodes[1].mesh, 1U);
    EXPECT_EQ(scene.nodes[1].local, Transform{});
    EXPECT_THAT(scene.roots, ElementsAre(0, 1));
}

TEST(ObjRead, calls_faces_before_any_object_default) {
    const Scene scene = read(square + "f 1 2 3\no late\nf 1 3 4\n");
    ASSERT_EQ(scene.meshes.size(), 2U);
    EXPECT_EQ(scene.meshes[0].name, "default");
}

TEST(ObjRead, does_not_take_groups_for_objects) {
    const Scene scene = read(square + "g a\nf 1 2 3\ng b\nf 1 3 4\n");
    EXPECT_EQ(scene.meshes.size(), 1U);
}

TEST(ObjRead, skips_objects_without_faces) {
    EXPECT_EQ(read(square + "o empty\no full\nf 1 2 3\n").meshes.size(), 1U);
}

TEST(ObjRead, reads_all_four_forms_of_a_corner) {
    struct Case {
        std::string face;
        bool uvs, normals;
    };
    const std::string attributes = "vt 0 0\nvt 1 0\nvt 1 1\nvn 0 0 1\n";
    for (const Case& c : {Case{"f 1 2 3", false, false}, Case{"f 1/1 2/2 3/3", true, false},
                          Case{"f 1//1 2//1 3//1", false, true}, Case{"f 1/1/1 2/2/1 3/3/1", true, true}}) {
        const Scene scene = read(square + attributes + c.face);
        EXPECT_EQ(scene.meshes[0].find_attribute("TEXCOORD_0") != nullptr, c.uvs) << c.face;
        EXPECT_EQ(scene.meshes[0].find_attribute("NORMAL") != nullptr, c.normals) << c.face;
    }
}

TEST(ObjRead, counts_negative_indices_back_from_the_line) {
    const Scene scene = read("v 9 9 9\nv 0 0 0\nv 1 0 0\nv 0 1 0\nf -3 -2 -1\nv 7 7 7\n");
    EXPECT_EQ(scene.meshes[0].positions[0], (Vec3f{0, 0, 0}));
}

TEST(ObjRead, takes_vertices_that_stand_after_their_faces) {
    EXPECT_EQ(read("f 1 2 3\n" + square).meshes[0].triangle_count(), 1U);
}

// Some algorithms go through the vertices by their numbers, and papers count what such a walk leaves.
TEST(ObjRead, numbers_the_vertices_that_an_object_uses_as_the_file_does) {
    const Scene scene = read(square + "o first\nf 4 2 3\no second\nf 3 4 1\n");
    const Mesh &first = scene.meshes[0], &second = scene.meshes[1];
    EXPECT_THAT(first.positions, ElementsAre(Vec3f{1, 0, 0}, Vec3f{1, 1, 0}, Vec3f{0, 1, 0}));
    EXPECT_EQ(first.corner_position(0, 0), (Vec3d{0, 1, 0}));
    EXPECT_EQ(first.corner_position(0, 1), (Vec3d{1, 0, 0}));
    EXPECT_THAT(second.positions, ElementsAre(Vec3f{0, 0, 0}, Vec3f{1, 1, 0}, Vec3f{0, 1, 0}));
    EXPECT_EQ(second.corner_position(0, 2), (Vec3d{0, 0, 0}));
}

TEST(ObjRead, gives_equal_vertices_the_number_of_the_first) {
    const Scene scene = read("v 1 1 0\nv 0 0 0\nv 1 0 0\nv 0 0 0\nf 4 3 1\nf 1 2 3\n");
    EXPECT_THAT(scene.meshes[0].positions, ElementsAre(Vec3f{1, 1, 0}, Vec3f{0, 0, 0}, Vec3f{1, 0, 0}));
}

TEST(ObjRead, flips_texture_coordinates_as_gltf_wants_them) {
    const Scene scene = read(square + "vt 0.25 0.75\nf 1/1 2/1 3/1\n");
    EXPECT_THAT(scene.meshes[0].find_attribute("TEXCOORD_0")->values,
                ElementsAre(0.25F, 0.25F, 0.25F, 0.25F, 0.25F, 0.25F));
}

TEST(ObjRead, keeps_vertex_colors_and_fills_with_white) {
    const Scene scene = read("v 0 0 0 1 0.5 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
    EXPECT_THAT(scene.meshes[0].find_attribute("COLOR_0")->values, ElementsAre(1, 0.5F, 0, 1, 1, 1, 1, 1, 1));
}

TEST(ObjRead, keeps_faces_with_and_without_texture_coordinates_apart) {
    const Scene scene = read(square + "vt 0 0\nvt 1 0\nvt 1 1\nf 1/1 2/2 3/3\nf 1 3 4\n");
    const Mesh& mesh = scene.meshes[0];
    ASSERT_EQ(mesh.slots.size(), 2U);
    EXPECT_THAT(mesh.slots[0].has_attribute, ElementsAre());
    EXPECT_THAT(mesh.slots[1].has_attribute, ElementsAre(false));
}

TEST(ObjRead, makes_a_slot_for_each_material) {
    const Scene scene = read(square + "usemtl red\nf 1 2 3\nusemtl blue\nf 1 3 4\nusemtl red\nf 1 2 4\n");
    EXPECT_THAT(scene.meshes[0].triangle_slot, ElementsAre(0, 1, 0));
    ASSERT_EQ(scene.materials.size(), 2U);
    EXPECT_EQ(scene.materials[1].name, "blue");
}

TEST(ObjRead, understands_comments_tabs_windows_line_ends_and_continuations) {
    const Scene scene = read("# hello\r\nv\t0 0 0 # here\r\nv 1 0 0\r\nv 0 1 0\r\nf 1 2 \\\r\n 3\r\n");
    EXPECT_EQ(scene.meshes[0].triangle_count(), 1U);
    EXPECT_TRUE(scene.warnings.empty());
}

TEST(ObjRead, reads_every_way_to_write_a_number) {
    const Scene scene = read(
        "v +1.5 -2. .25\nv 1e2 2.E+1 3.5e-1\nv 0.30000001192092896 123456789012345678901 1e-50\nf 1 2 3\n");
    const auto& p = scene.meshes[0].positions;
    EXPECT_EQ(p[0], (Vec3f{1.5F, -2, 0.25F}));
    EXPECT_EQ(p[1], (Vec3f{100, 20, 0.35F}));
    EXPECT_EQ(p[2], (Vec3f{0.3F, 123456789012345678901.0F, 0}));
}

TEST(ObjRead, refuses_positions_that_are_not_finite) {
    for (const std::string number : {"nan", "-inf", "1e39", "1e999"}) {
        const Error error = refused("v 0 0 0\nv 1 " + number + " 0\n");
        EXPECT_EQ(error.code(), ErrorCode::asset_malformed) << number;
        EXPECT_THAT(error.where(), HasSubstr("line 2, column ")) << number;
    }
}

TEST(ObjRead, repairs_other_values_that_are_not_finite) {
    const Scene scene =
        read("v 0 0 0 nan 0 0\nv 1 0 0\nv 0 1 0\nvt inf 0\nvn nan 0 0\nf 1/1/1 2/1/1 3/1/1\n");
    EXPECT_THAT(warning_codes(scene),
                testing::UnorderedElementsAre("repair.non_finite", "repair.non_finite", "repair.normals"));
    EXPECT_THAT(scene.meshes[0].find_attribute("NORMAL")->values, ElementsAre(0, 0, 1, 0, 0, 1, 0, 0, 1));
}

TEST(ObjRead, says_where_it_is_malformed) {
    const Error error = refused(square + "f 1 2 9x\n");
    EXPECT_EQ(error.code(), ErrorCode::asset_malformed);
    EXPECT_EQ(error.where(), "line 5, column 8");
}

TEST(ObjRead, refuses_indices_that_are_out_of_range) {
    for (const std::string face :
         {"f 1 2 5", "f 0 1 2", "f 1 2 -5", "f 1 2 99999999999", "f 1 2 4294967296"}) {
        const Error error = refused(square + face);
        EXPECT_EQ(error.code(), ErrorCode::asset_malformed) << face;
        EXPECT_THAT(error.where(), HasSubstr("line 5")) << face;
    }
}

TEST(ObjRead, refuses_a_face_of_two_corners_and_a_file_without_faces) {
    EXPECT_EQ(refused(square + "f 1 2\n").code(), ErrorCode::asset_malformed);
    EXPECT_EQ(refused("o empty\n").code(), ErrorCode::asset_malformed);
    for (const char* elements : {"", "l 1 2 3\n", "p 1 2\n"}) {
        const Error error = refused(square + elements);
        EXPECT_EQ(error.code(), ErrorCode::asset_unsupported) << elements;
        EXPECT_EQ(error.message(),
                  "the OBJ has no faces (4 vertices): points, lines and curves alone are not read");
    }
}

TEST(ObjRead, refuses_more_than_the_limits) {
    ReadLimits few_triangles;
    few_triangles.triangles = 1;
    EXPECT_EQ(refused(square + "f 1 2 3 4\n", few_triangles).code(), ErrorCode::asset_too_large);
    ReadLimits few_vertices;
    few_vertices.vertices = 3;
    EXPECT_EQ(refused(square + "f 1 2 3\n", few_vertices).code(), ErrorCode::asset_too_large);
}

TEST(ObjRead, warns_of_lines_and_points_that_it_loses) {
    EXPECT_THAT(warning_codes(read(square + "l 1 2\np 1\nf 1 2 3\n")),
                ElementsAre("obj.lines_lost", "obj.points_lost"));
}

TEST(ObjRead, stops_when_asked) {
    std::stop_source source;
    source.request_stop();
    Watch watch;
    watch.stop = source.get_token();
    EXPECT_THROW(read_obj(as_bytes(square + "f 1 2 3\n"), {}, {}, watch), Error);
}

}  // namespace
}  // namespace coppice
