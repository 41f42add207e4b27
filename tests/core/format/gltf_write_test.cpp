#include "tests/core/format/gltf_document.h"

#include "core/format/gltf/json_text.h"
#include "core/format/gltf/trs.h"

namespace coppice {

namespace {

using test::GltfBuilder;
using test::Json;
using test::read_again;
using test::square;
using test::written_json;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::SizeIs;

Mesh one_triangle() {
    Mesh mesh;
    mesh.name = "triangle";
    mesh.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
    mesh.wedge_vertex = {0, 1, 2};
    mesh.triangles = {0, 1, 2};
    mesh.triangle_slot = {0};
    mesh.slots = {{}};
    return mesh;
}

Scene one_instance(const Transform& transform) {
    Scene scene;
    scene.meshes = {one_triangle()};
    scene.nodes.resize(1);
    scene.nodes[0].name = "it";
    scene.nodes[0].mesh = 0;
    scene.nodes[0].local = transform;
    scene.roots = {0};
    return scene;
}

TEST(PrintJson, gives_the_text_of_the_whole_and_looks_at_the_stop_amid_long_arrays) {
    Json json = {{"empty", Json::array()},
                 {"a \"name\"", {1, "\u00e9", nullptr, {{"b", {2, 3}}}}},
                 {"object", Json::object()}};
    for (int i = 0; i < 10'000; ++i) json["nodes"].push_back({{"name", "node"}, {"mesh", i}});
    size_t checks = 0;
    EXPECT_EQ(gltf::print_json(json, {.checked = [&checks] { ++checks; }}), json.dump());
    EXPECT_GE(checks, 10U);
    for (const Json& value : {Json(1.5), Json::array({1, 2}), Json::object()})
        EXPECT_EQ(gltf::print_json(value), value.dump());
}

TEST(GltfWrite, gives_the_same_bytes_twice) {
    const Scene scene = test::read(square());
    EXPECT_EQ(write_glb(scene, {}, {}).bytes, write_glb(scene, {}, {}).bytes);
}

TEST(GltfWrite, keeps_what_it_does_not_know) {
    GltfBuilder builder = square();
    builder.json["extensionsUsed"] = {"X_words"};
    builder.json["extensions"]["X_words"] = {{"word", "hello"}};
    builder.json["nodes"][0]["extras"] = {{"id", 17}};
    builder.json["meshes"][0]["extras"] = {1, 2, 3};
    builder.json["meshes"][0]["primitives"][0]["extras"] = "primitive";
    builder.json["materials"] = {{{"name", "unused"}, {"extras", 1}}};
    builder.json["cameras"] = {{{"type", "perspective"}, {"perspective", {{"yfov", 1}, {"znear", 0.1}}}}};
    const Json out = written_json(test::read(builder));
    EXPECT_EQ(out["extensions"], builder.json["extensions"]);
    EXPECT_EQ(out["nodes"][0]["extras"], builder.json["nodes"][0]["extras"]);
    EXPECT_EQ(out["meshes"][0]["extras"], builder.json["meshes"][0]["extras"]);
    EXPECT_EQ(out["meshes"][0]["primitives"][0]["extras"], "primitive");
    EXPECT_EQ(out["materials"], builder.json["materials"]);
    EXPECT_EQ(out["cameras"], builder.json["cameras"]);
}

TEST(GltfWrite, stores_attributes_as_they_were) {
    GltfBuilder builder = square();
    builder.json["meshes"][0]["primitives"][0]["attributes"]["TEXCOORD_0"] = builder.add<uint16_t>(
        {0, 1, 65535, 2, 65535, 65535, 3, 65535}, 5123, "VEC2", 2, {{"normalized", true}});
    const Scene scene = test::read(builder);
    const Scene again = read_again(scene);
    const Attribute* uv = again.meshes[0].find_attribute("TEXCOORD_0");
    ASSERT_NE(uv, nullptr);
    EXPECT_EQ(uv->storage, (Storage{ComponentType::uint16, true}));
    EXPECT_EQ(uv->values, scene.meshes[0].find_attribute("TEXCOORD_0")->values);
}

// A square of two triangles, each a slot of its own.
Scene square_of_two_slots() {
    Scene scene = test::read(square());
    scene.source = nullptr;
    scene.meshes[0].slots.resize(2);
    scene.meshes[0].triangle_slot = {0, 1};
    return scene;
}

TEST(GltfWrite, stores_once_what_primitives_have_in_common) {
    const Scene scene = square_of_two_slots();
    const Json out = written_json(scene);
    const Json& primitives = out["meshes"][0]["primitives"];
    ASSERT_THAT(primitives, SizeIs(2));
    EXPECT_EQ(primitives[0]["attributes"], primitives[1]["attributes"]);
    EXPECT_NE(primitives[0]["indices"], primitives[1]["indices"]);
    EXPECT_EQ(out["accessors"][primitives[0]["attributes"]["POSITION"].get<size_t>()]["count"], 4);
    const Mesh again = read_again(scene).meshes[0];
    EXPECT_EQ(again.vertex_count(), 4U);
    EXPECT_EQ(again.triangle_slot, scene.meshes[0].triangle_slot);
}

TEST(GltfWrite, stores_apart_what_has_other_attributes) {
    Scene scene = square_of_two_slots();
    Mesh& mesh = scene.meshes[0];
    mesh.attributes = {
        {.name = "COLOR_0", .components = 3, .values = std::vector<float>(3 * mesh.wedge_count(), 0.5F)}};
    mesh.slots[1].has_attribute = {false};
    const Json out = written_json(scene);
    const Json& primitives = out["meshes"][0]["primitives"];
    EXPECT_TRUE(primitives[0]["attributes"].contains("COLOR_0"));
    EXPECT_FALSE(primitives[1]["attributes"].contains("COLOR_0"));
    EXPECT_EQ(out["accessors"][primitives[1]["attributes"]["POSITION"].get<size_t>()]["count"], 3);
}

TEST(GltfWrite, passes_points_and_animations_through) {
    GltfBuilder builder = square();
    Json points = builder.json["meshes"][0]["primitives"][0];
    points["mode"] = 0;
    builder.json["meshes"][0]["primitives"].push_back(points);
    const size_t times = builder.add<float>({0, 1}, 5126, "SCALAR", 1, {{"min", {0}}, {"max", {1}}});
    const size_t moves = builder.add<float>({0, 0, 0, 1, 2, 3}, 5126, "VEC3", 3);
    builder.json["animations"] = {
        {{"samplers", {{{"input", times}, {"output", moves}}}},
         {"channels", {{{"sampler", 0}, {"target", {{"node", 0}, {"path", "translation"}}}}}}}};
    const Scene scene = test::read(builder);
    EXPECT_TRUE(scene.nodes[0].animated);
    const Json out = written_json(scene);
    ASSERT_THAT(out["meshes"][0]["primitives"], SizeIs(2));
    EXPECT_EQ(out["meshes"][0]["primitives"][1]["mode"], 0);
    const auto output = out["animations"][0]["samplers"][0]["output"].get<size_t>();
    EXPECT_EQ(out["accessors"][output]["count"], 2);
    EXPECT_THAT(read_again(scene).warnings, IsEmpty());
}

TEST(GltfWrite, leaves_a_valid_mesh_where_no_triangle_is_left) {
    Scene scene = test::read(square());
    scene.meshes[0].triangles.clear();
    scene.meshes[0].triangle_slot.clear();
    const Json out = written_json(scene);
    EXPECT_THAT(out["meshes"][0]["primitives"], SizeIs(1));
    EXPECT_EQ(read_again(scene).nodes[0].mesh, 0U);
}

TEST(GltfWrite, makes_nodes_of_a_batch) {
    GltfBuilder builder = square();
    builder.json["extensionsUsed"] = {"EXT_mesh_gpu_instancing"};
    const size_t translations = builder.add<float>({1, 0, 0, 2, 0, 0}, 5126, "VEC3", 3);
    builder.json["nodes"][0]["extensions"]["EXT_mesh_gpu_instancing"]["attributes"] = {
        {"TRANSLATION", translations}};
    const Scene scene = test::read(builder);
    EXPECT_EQ(read_again(scene).nodes[0].batch, scene.nodes[0].batch);
    const Json out = written_json(scene, Instancing::nodes);
    EXPECT_THAT(out["nodes"], SizeIs(3));
    EXPECT_FALSE(out.contains("extensionsUsed"));
    EXPECT_EQ(out["nodes"][2]["mesh"], 0);
    EXPECT_FALSE(out["nodes"][0].contains("mesh"));
    EXPECT_THAT(written_json(scene, Instancing::expand)["meshes"], SizeIs(2));
}

TEST(GltfWrite, says_which_attributes_of_instances_single_nodes_cannot_have) {
    GltfBuilder builder = square();
    builder.json["extensionsUsed"] = {"EXT_mesh_gpu_instancing"};
    const size_t translations = builder.add<float>({1, 0, 0, 2, 0, 0}, 5126, "VEC3", 3);
    const size_t ids = builder.add<float>({7, 8}, 5126, "SCALAR", 1);
    builder.json["nodes"][0]["extensions"]["EXT_mesh_gpu_instancing"]["attributes"] = {
        {"TRANSLATION", translations}, {"_ID", ids}};
    const Scene scene = test::read(builder);
    EXPECT_THAT(write_glb(scene, {}, Watch()).warnings, IsEmpty());
    for (const Instancing instancing : {Instancing::nodes, Instancing::expand}) {
        const WrittenAsset written = write_glb(scene, {.instancing = instancing}, Watch());
        ASSERT_THAT(written.warnings, SizeIs(1));
        EXPECT_EQ(written.warnings[0].code, "format.lost");
        EXPECT_THAT(written.warnings[0].message, HasSubstr("_ID"));
    }
}

TEST(GltfWrite, writes_a_scene_that_never_was_gltf) {
    Scene scene = one_instance(from_trs({1, 2, 3}, {0, 0, 0, 1}, {2, 2, 2}));
    Material material;
    material.name = "paint";
    material.base_color_texture.image = 0;
    scene.materials = {material};
    scene.images = {{"picture", "image/png", "a b.png", to_bytes("not looked at")}};
    const Json out = written_json(scene);
    EXPECT_EQ(out["asset"]["generator"], "coppice");
    EXPECT_EQ(out["nodes"][0]["name"], "it");
    EXPECT_EQ(out["nodes"][0]["translation"], (Json{1, 2, 3}));
    EXPECT_EQ(out["images"][0]["mimeType"], "image/png");
    const GltfFiles files = write_gltf(scene, {}, {});
    ASSERT_THAT(files.files, SizeIs(3));
    EXPECT_EQ(files.files[2].path, "a b.png");
}

TEST(GltfWrite, splits_a_shearing_transform_into_two_nodes) {
    const Transform shear = {{1, 0.5, 0, 7, 0, 2, 0.25, 8, 0, 0, -3, 9}};
    const Scene again = read_again(one_instance(shear));
    ASSERT_THAT(again.nodes, SizeIs(2));
    const Transform both = again.nodes[0].local * again.nodes[1].local;
    for (size_t i = 0; i < 12; ++i) EXPECT_NEAR(both.m[i], shear.m[i], 1e-9) << i;
    EXPECT_EQ(again.nodes[1].mesh, 0U);
    EXPECT_EQ(again.nodes[0].name, "it");
}

TEST(GltfWrite, uses_short_indices_as_far_as_they_reach) {
    Mesh mesh = one_triangle();
    for (uint32_t i = 1; i < 22000; ++i) {
        const auto first = static_cast<uint32_t>(mesh.positions.size());
        for (uint32_t c = 0; c < 3; ++c) {
            mesh.positions.push_back({static_cast<float>(i), c == 1 ? 1.0F : 0.0F, c == 2 ? 1.0F : 0.0F});
            mesh.wedge_vertex.push_back(first + c);
            mesh.triangles.push_back(first + c);
        }
        mesh.triangle_slot.push_back(0);
    }
    Scene scene = one_instance({});
    scene.meshes = {mesh};
    const Json out = written_json(scene);
    EXPECT_EQ(out["accessors"][out["meshes"][0]["primitives"][0]["indices"].get<size_t>()]["componentType"],
              5125);
    EXPECT_EQ(written_json(one_instance({}))["accessors"][1]["componentType"], 5123);
}

TEST(GltfWrite, keeps_every_accessor_where_an_unknown_extension_may_count_on_it) {
    GltfBuilder builder = square();
    builder.json["extensionsUsed"] = {"X_indices"};
    builder.json["nodes"][0]["extensions"]["X_indices"] = {{"accessor", 1}};
    const Scene scene = test::read(builder);
    EXPECT_THAT(test::warning_codes(scene), ::testing::ElementsAre("extension.unknown"));
    const Json out = written_json(scene);
    for (size_t i = 0; i < 2; ++i)
        EXPECT_EQ(out["accessors"][i]["count"], builder.json["accessors"][i]["count"]);
    EXPECT_EQ(out["nodes"][0]["extensions"], builder.json["nodes"][0]["extensions"]);
}

TEST(GltfWrite, takes_the_buffer_views_of_metadata_along) {
    GltfBuilder builder = square();
    builder.add<uint32_t>({7, 8}, 5125, "SCALAR", 1);
    builder.json["accessors"].erase(2);
    builder.json["extensionsUsed"] = {"EXT_structural_metadata"};
    builder.json["extensions"]["EXT_structural_metadata"]["propertyTables"] = {
        {{"class", "a"}, {"count", 2}, {"properties", {{"id", {{"values", 2}}}}}}};
    const Json out = written_json(test::read(builder));
    const Json& property =
        out["extensions"]["EXT_structural_metadata"]["propertyTables"][0]["properties"]["id"];
    const Json& view = out["bufferViews"][property["values"].get<size_t>()];
    EXPECT_EQ(view["byteLength"], 8);
    EXPECT_EQ(view["byteOffset"].get<size_t>() % 8, 0U);
}

}  // namespace

}  // namespace coppice
