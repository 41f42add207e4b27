#include "tests/core/format/gltf_document.h"

#include <cmath>
#include <limits>

namespace coppice {

namespace {

using test::GltfBuilder;
using test::Json;
using test::square;
using ::testing::Contains;
using ::testing::ElementsAre;
using ::testing::IsEmpty;
using ::testing::SizeIs;

test::Json& primitive(GltfBuilder& builder) {
    return builder.json["meshes"][0]["primitives"][0];
}

TEST(GltfRead, reads_a_glb_with_a_square) {
    const Scene scene = test::read(square());
    ASSERT_THAT(scene.meshes, SizeIs(1));
    EXPECT_EQ(scene.meshes[0].name, "square");
    EXPECT_EQ(scene.meshes[0].triangle_count(), 2U);
    EXPECT_EQ(scene.meshes[0].vertex_count(), 4U);
    EXPECT_THAT(scene.roots, ElementsAre(0U));
    EXPECT_THAT(scene.warnings, IsEmpty());
}

TEST(GltfRead, reads_json_with_a_data_uri) {
    const std::string text = square().gltf();
    EXPECT_EQ(test::read(as_bytes(text)).meshes[0].triangle_count(), 2U);
}

TEST(GltfRead, finds_a_buffer_in_the_upload) {
    GltfBuilder builder = square();
    builder.json["buffers"] = {{{"byteLength", builder.buffer.size()}, {"uri", "a%20b.bin"}}};
    const std::string text = builder.json.dump();
    const Resources resources({{"a b.bin", builder.buffer}});
    EXPECT_EQ(read_gltf(as_bytes(text), resources, {}, {}).meshes[0].triangle_count(), 2U);
}

TEST(GltfRead, unrolls_strips_with_every_second_triangle_turned) {
    GltfBuilder builder = square();
    primitive(builder)["indices"] = builder.add<uint8_t>({0, 1, 3, 2}, 5121, "SCALAR", 1);
    primitive(builder)["mode"] = 5;
    const Scene scene = test::read(builder);
    ASSERT_EQ(scene.meshes[0].triangle_count(), 2U);
    for (size_t t = 0; t < 2; ++t) {
        const Mesh& mesh = scene.meshes[0];
        const Vec3d a = mesh.corner_position(t, 0);
        EXPECT_GT(cross(mesh.corner_position(t, 1) - a, mesh.corner_position(t, 2) - a).z, 0);
    }
}

TEST(GltfRead, unrolls_fans_without_indices) {
    GltfBuilder builder = square();
    primitive(builder).erase("indices");
    primitive(builder)["mode"] = 6;
    EXPECT_EQ(test::read(builder).meshes[0].triangle_count(), 2U);
}

TEST(GltfRead, welds_two_primitives_into_one_mesh_with_two_slots) {
    GltfBuilder builder = square();
    builder.json["materials"] = {{{"name", "red"}}, {{"name", "blue"}}};
    Json first = primitive(builder);
    first["indices"] = builder.add<uint16_t>({0, 1, 2}, 5123, "SCALAR", 1);
    first["material"] = 0;
    Json second = first;
    second["indices"] = builder.add<uint32_t>({0, 2, 3}, 5125, "SCALAR", 1);
    second["material"] = 1;
    builder.json["meshes"][0]["primitives"] = {first, second};
    const Scene scene = test::read(builder);
    EXPECT_EQ(scene.meshes[0].vertex_count(), 4U);
    ASSERT_THAT(scene.meshes[0].slots, SizeIs(2));
    EXPECT_EQ(scene.meshes[0].slots[1].material, 1U);
    EXPECT_EQ(scene.meshes[0].slots[1].source_primitive, 1U);
}

TEST(GltfRead, decodes_normalized_integers_and_remembers_them) {
    GltfBuilder builder = square();
    primitive(builder)["attributes"]["TEXCOORD_0"] = builder.add<uint16_t>(
        {0, 0, 65535, 0, 65535, 65535, 0, 65535}, 5123, "VEC2", 2, {{"normalized", true}});
    const Scene scene = test::read(builder);
    const Attribute* uv = scene.meshes[0].find_attribute("TEXCOORD_0");
    ASSERT_NE(uv, nullptr);
    EXPECT_EQ(uv->values[2], 1.0F);
    EXPECT_EQ(uv->storage, (Storage{ComponentType::uint16, true}));
}

TEST(GltfRead, applies_sparse_values_over_zeros) {
    GltfBuilder builder = square();
    builder.add<uint16_t>({2}, 5123, "SCALAR", 1);
    builder.add<float>({5, 6}, 5126, "VEC2", 2);
    const size_t views = builder.json["bufferViews"].size();
    builder.json["accessors"].push_back({{"componentType", 5126},
                                         {"count", 4},
                                         {"type", "VEC2"},
                                         {"sparse",
                                          {{"count", 1},
                                           {"indices", {{"bufferView", views - 2}, {"componentType", 5123}}},
                                           {"values", {{"bufferView", views - 1}}}}}});
    primitive(builder)["attributes"]["TEXCOORD_0"] = builder.json["accessors"].size() - 1;
    const Attribute uv = *test::read(builder).meshes[0].find_attribute("TEXCOORD_0");
    EXPECT_THAT(uv.values, ElementsAre(0, 0, 0, 0, 5, 6, 0, 0));
}

TEST(GltfRead, reads_gpu_instances_as_a_batch) {
    GltfBuilder builder = square();
    builder.json["extensionsUsed"] = {"EXT_mesh_gpu_instancing"};
    const size_t translations = builder.add<float>({1, 0, 0, 2, 0, 0}, 5126, "VEC3", 3);
    const size_t rotations =
        builder.add<int8_t>({0, 0, 0, 127, 0, 0, 127, 0}, 5120, "VEC4", 4, {{"normalized", true}});
    builder.json["nodes"][0]["extensions"]["EXT_mesh_gpu_instancing"]["attributes"] = {
        {"TRANSLATION", translations}, {"ROTATION", rotations}};
    const Scene scene = test::read(builder);
    ASSERT_THAT(scene.nodes[0].batch, SizeIs(2));
    EXPECT_EQ(scene.nodes[0].batch[1].point({1, 0, 0}), (Vec3d{1, 0, 0}));
}

TEST(GltfRead, repairs_normals_bounds_and_degenerate_triangles_with_warnings) {
    GltfBuilder builder = square();
    primitive(builder)["attributes"]["NORMAL"] =
        builder.add<float>({0, 0, 2, 0, 0, 1, 0, 0, 1, 0, 0, 1}, 5126, "VEC3", 3);
    primitive(builder)["indices"] =
        builder.add<uint16_t>({0, 1, 2, 0, 2, 3, 1, 1, 2, 0, 1, 2}, 5123, "SCALAR", 1);
    builder.json["accessors"][0]["max"] = {2, 1, 0};
    const Scene scene = test::read(builder);
    const std::vector<std::string> codes = test::warning_codes(scene);
    for (const char* code :
         {"repair.normals", "repair.bounds", "repair.degenerate_triangles", "repair.duplicate_triangles"})
        EXPECT_THAT(codes, Contains(code));
    EXPECT_EQ(scene.meshes[0].find_attribute("NORMAL")->values[2], 1.0F);
    EXPECT_EQ(scene.meshes[0].triangle_count(), 2U);
}

TEST(GltfRead, zeroes_texture_coordinates_that_are_no_numbers) {
    GltfBuilder builder = square();
    const float nan = std::numeric_limits<float>::quiet_NaN();
    primitive(builder)["attributes"]["TEXCOORD_0"] =
        builder.add<float>({nan, 0, 1, 0, 1, 1, 0, 1}, 5126, "VEC2", 2);
    const Scene scene = test::read(builder);
    EXPECT_THAT(test::warning_codes(scene), ElementsAre("repair.non_finite"));
    EXPECT_EQ(scene.meshes[0].find_attribute("TEXCOORD_0")->values[0], 0.0F);
}

TEST(GltfRead, takes_positions_from_quantized_integers) {
    GltfBuilder builder = square();
    builder.json["extensionsUsed"] = {"KHR_mesh_quantization"};
    builder.json["extensionsRequired"] = {"KHR_mesh_quantization"};
    const size_t quantized =
        builder.add<int16_t>({0, 0, 0, 0, 100, 0, 0, 0, 100, 100, 0, 0, 0, 100, 0, 0}, 5122, "VEC3", 4,
                             {{"min", {0, 0, 0}}, {"max", {100, 100, 0}}});
    builder.json["bufferViews"].back()["byteStride"] = 8;
    primitive(builder)["attributes"]["POSITION"] = quantized;
    const Scene scene = test::read(builder);
    EXPECT_EQ(scene.meshes[0].positions[1], (Vec3f{100, 0, 0}));
    EXPECT_EQ(scene.meshes[0].position_storage.type, ComponentType::int16);
}

}  // namespace

}  // namespace coppice
