// What is refused, and how it is told.
#include <limits>

#include "core/format/gltf/glb.h"
#include "tests/core/format/gltf_document.h"

namespace coppice {

namespace {

using test::error_of;
using test::GltfBuilder;
using test::Json;
using test::square;
using ::testing::HasSubstr;
using ::testing::StartsWith;

struct Spoilt {
    const char* name;
    std::function<void(Json&)> spoil;
    const char* error;  // how the answer begins: code and where
};

class GltfRefuses : public ::testing::TestWithParam<Spoilt> {};

TEST_P(GltfRefuses, naming_the_place) {
    GltfBuilder builder = square();
    GetParam().spoil(builder.json);
    EXPECT_THAT(error_of(builder), StartsWith(GetParam().error));
}

const Spoilt spoilt[] = {
    {"another_version", [](Json& j) { j["asset"]["version"] = "1.0"; }, "asset.unsupported /asset/version"},
    {"no_asset", [](Json& j) { j.erase("asset"); }, "asset.malformed :"},
    {"count_of_2_to_the_62", [](Json& j) { j["accessors"][1]["count"] = 4611686018427387904U; },
     "asset.malformed /accessors/1/count"},
    {"count_that_is_too_large", [](Json& j) { j["accessors"][1]["count"] = 1000000000; },
     "asset.malformed /accessors/1"},
    {"negative_count", [](Json& j) { j["accessors"][1]["count"] = -1; },
     "asset.malformed /accessors/1/count"},
    {"count_with_a_fraction", [](Json& j) { j["accessors"][1]["count"] = 1.5; },
     "asset.malformed /accessors/1/count"},
    {"view_99_of_2", [](Json& j) { j["accessors"][0]["bufferView"] = 99; },
     "asset.malformed /accessors/0/bufferView"},
    {"view_past_its_buffer", [](Json& j) { j["bufferViews"][0]["byteLength"] = 4096; },
     "asset.malformed /bufferViews/0"},
    {"offset_that_overflows", [](Json& j) { j["bufferViews"][0]["byteOffset"] = 9007199254740991U; },
     "asset.malformed /bufferViews/0"},
    {"unaligned_accessor", [](Json& j) { j["accessors"][1]["byteOffset"] = 1; },
     "asset.malformed /accessors/1"},
    {"attributes_of_unequal_counts",
     [](Json& j) {
         j["accessors"][0]["count"] = 3;
         j["accessors"][0]["max"] = {1, 1, 0};
     },
     "asset.malformed /meshes/0/primitives/0/indices"},
    {"positions_without_bounds", [](Json& j) { j["accessors"][0].erase("min"); },
     "asset.malformed /meshes/0/primitives/0/attributes/POSITION"},
    {"unknown_attribute", [](Json& j) { j["meshes"][0]["primitives"][0]["attributes"]["COLOUR"] = 0; },
     "asset.malformed /meshes/0/primitives/0/attributes/COLOUR"},
    {"indices_of_floats", [](Json& j) { j["meshes"][0]["primitives"][0]["indices"] = 0; },
     "asset.malformed /meshes/0"},
    {"mode_7", [](Json& j) { j["meshes"][0]["primitives"][0]["mode"] = 7; },
     "asset.malformed /meshes/0/primitives/0/mode"},
    {"node_loop",
     [](Json& j) {
         j["nodes"] = {{{"children", {1}}}, {{"children", {0}}}};
     },
     "asset.malformed /nodes/"},
    {"node_with_two_parents",
     [](Json& j) {
         j["nodes"] = {{{"children", {2}}}, {{"children", {2}}}, {{"mesh", 0}}};
     },
     "asset.malformed /nodes/1/children/0"},
    {"scene_with_a_child",
     [](Json& j) {
         j["nodes"] = {{{"children", {1}}}, {{"mesh", 0}}};
         j["scenes"][0]["nodes"] = {1};
     },
     "asset.malformed /scenes/0/nodes/0"},
    {"matrix_beside_translation",
     [](Json& j) {
         j["nodes"][0]["translation"] = {0, 0, 0};
         j["nodes"][0]["matrix"] = {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1};
     },
     "asset.malformed /nodes/0/matrix"},
    {"matrix_that_shears",
     [](Json& j) { j["nodes"][0]["matrix"] = {1, 0, 0, 0, 1, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1}; },
     "asset.malformed /nodes/0/matrix"},
    {"missing_material", [](Json& j) { j["meshes"][0]["primitives"][0]["material"] = 3; },
     "asset.malformed /meshes/0/primitives/0/material"},
    {"undeclared_extension", [](Json& j) { j["nodes"][0]["extensions"]["X_y"] = Json::object(); },
     "asset.malformed /nodes/0/extensions/X_y"},
    {"required_extension_on_a_node",
     [](Json& j) {
         j["extensionsUsed"] = {"X_y"};
         j["extensionsRequired"] = {"X_y"};
         j["nodes"][0]["extensions"]["X_y"] = Json::object();
     },
     "asset.extension_unsupported /nodes/0"},
    {"buffer_outside_the_upload",
     [](Json& j) {
         j["images"] = {{{"uri", "../../etc/passwd"}}};
     },
     "resource.forbidden"},
    {"buffer_outside_in_escapes",
     [](Json& j) {
         j["images"] = {{{"uri", "%2e%2e/passwd"}}};
     },
     "resource.forbidden"},
    {"missing_image",
     [](Json& j) {
         j["images"] = {{{"uri", "a.png"}}};
     },
     "resource.missing /images/0/uri"},
};

INSTANTIATE_TEST_SUITE_P(Gltf, GltfRefuses, ::testing::ValuesIn(spoilt),
                         [](const auto& of) { return std::string(of.param.name); });

TEST(GltfRefuse, an_index_out_of_range) {
    GltfBuilder builder = square();
    builder.json["meshes"][0]["primitives"][0]["indices"] =
        builder.add<uint16_t>({0, 1, 9}, 5123, "SCALAR", 1);
    EXPECT_THAT(error_of(builder), HasSubstr("element 2 is 9, but there are 4 vertices"));
}

TEST(GltfRefuse, a_position_that_is_no_number) {
    GltfBuilder builder = square();
    const float nan = std::numeric_limits<float>::quiet_NaN();
    const size_t positions = builder.add<float>({nan, 0, 0, 1, 0, 0, 1, 1, 0}, 5126, "VEC3", 3,
                                                {{"min", {0, 0, 0}}, {"max", {1, 1, 0}}});
    builder.json["meshes"][0]["primitives"][0] = {{"attributes", {{"POSITION", positions}}}};
    EXPECT_THAT(error_of(builder), StartsWith("asset.malformed /accessors/2"));
}

TEST(GltfRefuse, every_truncation_of_a_glb) {
    const Bytes whole = square().glb();
    for (size_t size = 4; size < whole.size(); ++size) {
        const ByteView part = ByteView(whole).first(size);
        EXPECT_THAT(error_of([&] { test::read(part); }), StartsWith("asset.malformed")) << size;
    }
}

TEST(GltfRefuse, json_nested_too_deep) {
    const std::string text =
        R"({"asset":{"version":"2.0"},"extras":)" + std::string(100000, '[') + std::string(100000, ']') + "}";
    EXPECT_THAT(error_of([&] { test::read(as_bytes(text)); }), HasSubstr("json_depth"));
}

TEST(GltfRefuse, a_key_that_is_there_twice) {
    const std::string text = R"({"asset":{"version":"2.0"},"asset":{}})";
    EXPECT_THAT(error_of([&] { test::read(as_bytes(text)); }), HasSubstr("'asset' twice"));
}

TEST(GltfRefuse, broken_json_with_line_and_column) {
    EXPECT_THAT(error_of([] { test::read(as_bytes("{\n  \"asset\": nope}")); }), HasSubstr("line 2 column"));
}

TEST(GltfRefuse, more_instances_than_the_limit_before_it_makes_them) {
    GltfBuilder builder = square();
    builder.json["extensionsUsed"] = {"EXT_mesh_gpu_instancing"};
    builder.json["accessors"].push_back({{"componentType", 5126}, {"count", 20000000}, {"type", "VEC3"}});
    builder.json["nodes"][0]["extensions"]["EXT_mesh_gpu_instancing"]["attributes"] = {{"TRANSLATION", 2}};
    EXPECT_THAT(error_of(builder), HasSubstr("limit instances"));
}

TEST(GltfRefuse, nodes_deeper_than_the_limit) {
    GltfBuilder builder = square();
    Json nodes = Json::array();
    for (int i = 1; i < 200; ++i) nodes.push_back({{"children", {i}}});
    nodes.push_back({{"mesh", 0}});
    builder.json["nodes"] = nodes;
    EXPECT_THAT(error_of(builder), HasSubstr("node_depth"));
}

}  // namespace

}  // namespace coppice
