#include "core/format/obj/write_obj.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>

#include "core/format/obj/read_obj.h"
#include "tests/core/format/gltf_document.h"

namespace coppice {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::Not;

const std::string textured_square =
    "mtllib m.mtl\no square\nv 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\n"
    "vt 0 0.1\nvt 1 0.1\nvt 1 0.7\nvt 0 0.7\nvn 0 0 1\nusemtl red\nf 1/1/1 2/2/1 3/3/1\nf 1/1/1 3/3/1 "
    "4/4/1\n";

Scene read(const std::string& text, const Resources& resources = {}) {
    return read_obj(as_bytes(text), resources, {}, Watch{});
}

ObjFiles write(const Scene& scene) {
    return write_obj(scene, {.format = Format::obj}, Watch{});
}

std::string text_of(const ObjFiles& files) {
    return std::string(as_text(files.files.front().bytes));
}

std::vector<std::string> paths(const ObjFiles& files) {
    std::vector<std::string> out;
    for (const NamedFile& file : files.files) out.push_back(file.path);
    return out;
}

TEST(ObjWrite, writes_what_it_read) {
    const Resources resources({{"m.mtl", as_bytes("newmtl red\nKd 1 0 0\n")}});
    EXPECT_EQ(text_of(write(read(textured_square, resources))), "# OBJ by coppice\n" + textured_square);
}

TEST(ObjWrite, bakes_transforms_and_turns_mirrored_triangles) {
    Scene scene = read("v 0 0 0\nv 1 0 0\nv 0 1 0\nvn 0 0.6 0.8\nf 1//1 2//1 3//1\n");
    scene.nodes[0].local.m = {-2, 0, 0, 10, 0, 1, 0, 0, 0, 0, 1, 0};
    const Mesh mesh = read(text_of(write(scene))).meshes[0];
    const Vec3d a = mesh.corner_position(0, 0);
    const Vec3d area = cross(mesh.corner_position(0, 1) - a, mesh.corner_position(0, 2) - a);
    EXPECT_EQ(area, (Vec3d{0, 0, 2}));
    EXPECT_THAT(mesh.find_attribute("NORMAL")->values,
                ElementsAre(0, 0.6F, 0.8F, 0, 0.6F, 0.8F, 0, 0.6F, 0.8F));
}

TEST(ObjWrite, writes_an_object_for_each_instance_and_counts_bytes_by_mesh) {
    Scene scene = read("o rock\nv 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
    scene.nodes.push_back(scene.nodes[0]);
    scene.roots.push_back(1);
    const ObjFiles files = write(scene);
    EXPECT_THAT(text_of(files), HasSubstr("o rock\nv 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n"));
    EXPECT_THAT(text_of(files), HasSubstr("o rock-2\nv 0 0 0\nv 1 0 0\nv 0 1 0\nf 4 5 6\n"));
    EXPECT_THAT(files.mesh_bytes,
                ElementsAre(text_of(files).size() - std::string("# OBJ by coppice\n").size()));
}

TEST(ObjWrite, keeps_vertex_colors) {
    const std::string object = "o default\nv 0 0 0 1 0.5 0\nv 1 0 0 0 0.5 0\nv 0 1 0 1 1 1\nf 1 2 3\n";
    EXPECT_THAT(text_of(write(read(object))), HasSubstr(object));
}

TEST(ObjWrite, passes_libraries_and_textures_through) {
    const std::string mtl = "# made by hand\nnewmtl red\nKs 1 1 1\nmap_Kd maps/red.png\nmap_Ks shiny.png\n";
    const Resources resources(
        {{"m.mtl", as_bytes(mtl)}, {"maps/red.png", as_bytes("red")}, {"shiny.png", as_bytes("s")}});
    const ObjFiles files = write(read(textured_square, resources));
    EXPECT_THAT(paths(files), ElementsAre("scene.obj", "m.mtl", "maps/red.png", "shiny.png"));
    EXPECT_EQ(as_text(files.files[1].bytes), mtl);
}

TEST(ObjWrite, makes_a_library_for_scenes_of_other_formats) {
    Scene scene = read(textured_square);
    scene.source.reset();
    scene.materials[0].base_color = {0.5F, 0.25F, 1, 0.5F};
    scene.materials[0].alpha = Material::Alpha::blend;
    scene.materials[0].base_color_texture.image = 0;
    scene.images.push_back({"bark", "image/png", "", to_bytes("png")});
    scene.images.push_back({"unused", "image/png", "", to_bytes("png")});
    const ObjFiles files = write(scene);
    EXPECT_THAT(paths(files), ElementsAre("scene.obj", "scene.mtl", "textures/bark.png"));
    EXPECT_THAT(text_of(files), HasSubstr("mtllib scene.mtl\n"));

    const Resources resources(
        {{"scene.mtl", files.files[1].bytes}, {"textures/bark.png", files.files[2].bytes}});
    const Scene again = read(text_of(files), resources);
    ASSERT_EQ(again.materials.size(), 1U);
    EXPECT_EQ(again.materials[0].base_color, scene.materials[0].base_color);
    EXPECT_EQ(again.materials[0].alpha, Material::Alpha::blend);
    EXPECT_EQ(again.images.size(), 1U);
}

TEST(ObjWrite, says_which_faces_have_no_material) {
    Scene scene = read("v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\nusemtl red\nf 1 3 2\n");
    EXPECT_THAT(text_of(write(scene)), HasSubstr("f 1 2 3\nusemtl red\nf 1 3 2\n"));
    scene.source.reset();
    std::swap(scene.meshes[0].slots[0], scene.meshes[0].slots[1]);
    EXPECT_THAT(text_of(write(scene)), HasSubstr("usemtl red\nf 1 2 3\nusemtl default\nf 1 3 2\n"));
}

TEST(ObjWrite, warns_of_what_obj_cannot_hold) {
    Scene scene = read("v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
    Mesh& mesh = scene.meshes[0];
    for (const char* name : {"TANGENT", "TEXCOORD_1", "JOINTS_0"})
        mesh.attributes.push_back({name, 2, {}, std::vector<float>(6)});
    mesh.morph_targets.resize(1);
    EXPECT_EQ(write(scene).warnings.size(), 4U);
}

TEST(ObjWrite, warns_of_what_a_gltf_has_and_obj_cannot_hold) {
    test::GltfBuilder builder = test::square();
    test::Json& json = builder.json;
    test::Json& primitives = json["meshes"][0]["primitives"];
    for (const int mode : {0, 1}) {
        primitives.push_back(primitives[0]);
        primitives.back()["mode"] = mode;
    }
    json["cameras"] = {{{"type", "perspective"}, {"perspective", {{"yfov", 1}, {"znear", 1}}}}};
    json["extensionsUsed"] = {"KHR_lights_punctual", "EXT_mesh_gpu_instancing", "KHR_texture_transform"};
    json["extensions"]["KHR_lights_punctual"]["lights"] = {{{"type", "point"}}};
    json["textures"] = {test::Json::object()};
    json["materials"] = {{{"emissiveTexture",
                           {{"index", 0}, {"extensions", {{"KHR_texture_transform", {{"rotation", 1}}}}}}}}};
    const size_t times = builder.add<float>({0, 1}, 5126, "SCALAR", 1, {{"min", {0}}, {"max", {1}}});
    const size_t moves = builder.add<float>({0, 0, 0, 1, 2, 3}, 5126, "VEC3", 3);
    json["animations"] = {
        {{"samplers", {{{"input", times}, {"output", moves}}}},
         {"channels", {{{"sampler", 0}, {"target", {{"node", 0}, {"path", "translation"}}}}}}}};
    test::Json& node = json["nodes"][0];
    node["camera"] = 0;
    node["extensions"]["KHR_lights_punctual"]["light"] = 0;
    node["extensions"]["EXT_mesh_gpu_instancing"]["attributes"]["_ID"] =
        builder.add<float>({7}, 5126, "SCALAR", 1);

    std::vector<std::string> told;
    for (const Warning& warning : write(test::read(builder)).warnings) told.push_back(warning.message);
    for (const char* what : {"cameras", "lights", "animations", "points", "lines", "transforms of textures",
                             "attributes of instances"})
        EXPECT_THAT(told, testing::Contains("OBJ holds no " + std::string(what)));
}

TEST(ObjWrite, leaves_out_vertices_that_no_triangle_uses) {
    Scene scene = read("v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
    scene.meshes[0].positions.insert(scene.meshes[0].positions.begin(), Vec3f{9, 9, 9});
    for (uint32_t& vertex : scene.meshes[0].wedge_vertex) ++vertex;
    EXPECT_THAT(text_of(write(scene)), Not(HasSubstr("9")));
}

}  // namespace
}  // namespace coppice
