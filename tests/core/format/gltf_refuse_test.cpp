// What is refused, and how it is told.
#include <limits>

#include "core/format/gltf/check_schema.h"
#include "core/format/gltf/checks.h"
#include "core/format/gltf/glb.h"
#include "core/format/gltf/read_buffers.h"
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
    std::string error;  // code and where
};

class GltfRefuses : public ::testing::TestWithParam<Spoilt> {};

TEST_P(GltfRefuses, naming_the_place) {
    GltfBuilder builder = square();
    GetParam().spoil(builder.json);
    EXPECT_THAT(error_of(builder), StartsWith(GetParam().error + ": "));
}

// What is there and wrong, or what has not what it must have.
TEST_P(GltfRefuses, at_a_place_that_is_in_the_document) {
    GltfBuilder builder = square();
    GetParam().spoil(builder.json);
    const std::string where = GetParam().error.substr(GetParam().error.find(' ') + 1);
    EXPECT_TRUE(builder.json.contains(Json::json_pointer(where))) << where;
}

const Spoilt spoilt[] = {
    {"another_version", [](Json& j) { j["asset"]["version"] = "1.0"; }, "asset.unsupported /asset/version"},
    {"no_asset", [](Json& j) { j.erase("asset"); }, "asset.malformed "},
    {"count_of_2_to_the_62", [](Json& j) { j["accessors"][1]["count"] = 4611686018427387904U; },
     "asset.malformed /accessors/1/count"},
    {"count_that_is_too_large", [](Json& j) { j["accessors"][1]["count"] = 1000000000; },
     "asset.malformed /accessors/1"},
    {"min_of_too_few_numbers",
     [](Json& j) {
         j["accessors"][0]["min"] = {0, 0};
     },
     "asset.malformed /accessors/0/min"},
    {"max_with_a_text", [](Json& j) { j["accessors"][0]["max"][2] = "far"; },
     "asset.malformed /accessors/0/max/2"},
    {"type_VEC5", [](Json& j) { j["accessors"][0]["type"] = "VEC5"; }, "asset.malformed /accessors/0/type"},
    {"component_type_of_doubles", [](Json& j) { j["accessors"][0]["componentType"] = 5130; },
     "asset.malformed /accessors/0/componentType"},
    {"normalized_floats", [](Json& j) { j["accessors"][0]["normalized"] = true; },
     "asset.malformed /accessors/0/normalized"},
    {"more_sparse_elements_than_elements",
     [](Json& j) {
         j["accessors"][0]["sparse"] = {{"count", 5},
                                        {"indices", {{"bufferView", 1}, {"componentType", 5123}}},
                                        {"values", {{"bufferView", 0}}}};
     },
     "asset.malformed /accessors/0/sparse/count"},
    {"sparse_indices_that_do_not_increase",
     [](Json& j) {
         j["bufferViews"].push_back(j["bufferViews"][1]);
         j["bufferViews"].push_back(j["bufferViews"][0]);
         j["accessors"][0]["sparse"] = {{"count", 4},
                                        {"indices", {{"bufferView", 2}, {"componentType", 5123}}},
                                        {"values", {{"bufferView", 3}}}};
     },
     "asset.malformed /accessors/0/sparse/indices"},
    {"stride_that_is_no_multiple_of_4", [](Json& j) { j["bufferViews"][0]["byteStride"] = 14; },
     "asset.malformed /bufferViews/0/byteStride"},
    {"rotation_of_no_length",
     [](Json& j) {
         j["nodes"][0]["rotation"] = {0, 0, 0, 0};
     },
     "asset.malformed /nodes/0/rotation"},
    {"skin_without_a_mesh",
     [](Json& j) {
         j["nodes"].push_back({{"skin", 0}});
         j["skins"] = {{{"joints", {0}}}};
     },
     "asset.malformed /nodes/1/skin"},
    {"weights_of_no_morph_targets", [](Json& j) { j["meshes"][0]["weights"] = {1}; },
     "asset.malformed /meshes/0/weights"},
    {"texture_of_no_image",
     [](Json& j) {
         j["textures"] = {{{"source", 0}}};
     },
     "asset.malformed /textures/0/source"},
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
     "asset.malformed /meshes/0/primitives/0/indices"},
    {"mode_7", [](Json& j) { j["meshes"][0]["primitives"][0]["mode"] = 7; },
     "asset.malformed /meshes/0/primitives/0/mode"},
    {"node_loop",
     [](Json& j) {
         j["nodes"] = {{{"children", {1}}}, {{"children", {0}}}};
     },
     "asset.malformed /nodes/0"},
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
     "resource.forbidden /images/0/uri"},
    {"buffer_outside_in_escapes",
     [](Json& j) {
         j["images"] = {{{"uri", "%2e%2e/passwd"}}};
     },
     "resource.forbidden /images/0/uri"},
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

// What reading it within such limits throws.
std::string error_within(const ReadLimits& limits, const GltfBuilder& builder) {
    const Bytes bytes = builder.glb();
    return error_of([&] { read_gltf(bytes, Resources(), limits, Watch()); });
}

// An accessor of zeros, which takes no byte of the file.
size_t add_zeros(GltfBuilder& builder, size_t count, const char* type) {
    builder.json["accessors"].push_back({{"componentType", 5126},
                                         {"count", count},
                                         {"type", type},
                                         {"min", Json::array({0, 0, 0})},
                                         {"max", Json::array({0, 0, 0})}});
    return builder.json["accessors"].size() - 1;
}

TEST(GltfRefuse, a_mesh_with_more_attributes_than_the_limit) {
    GltfBuilder builder = square();
    Json& attributes = builder.json["meshes"][0]["primitives"][0]["attributes"];
    for (int i = 0; i < 5000; ++i) attributes[fmt::format("_{}", i)] = 0;
    EXPECT_THAT(error_of(builder), StartsWith("asset.too_large /meshes/0/primitives/0"));
    EXPECT_THAT(error_of(builder), HasSubstr("limit attributes"));
}

TEST(GltfRefuse, more_attributes_of_morph_targets_than_the_limit) {
    GltfBuilder builder = square();
    for (int i = 0; i < 5000; ++i)
        builder.json["meshes"][0]["primitives"][0]["targets"].push_back({{"POSITION", 0}});
    EXPECT_THAT(error_of(builder), HasSubstr("limit attributes"));
}

TEST(GltfRefuse, accessors_of_more_bytes_than_the_limit) {
    GltfBuilder builder = square();
    for (int i = 0; i < 4; ++i) add_zeros(builder, 29'000'000, "VEC3");
    EXPECT_THAT(error_of(builder), HasSubstr("limit attribute_bytes"));
}

TEST(GltfRefuse, attributes_that_would_take_more_bytes_than_the_limit) {
    GltfBuilder builder = square();
    Json& primitive = builder.json["meshes"][0]["primitives"][0];
    for (int i = 0; i < 10; ++i) primitive["attributes"][fmt::format("_{}", i)] = 0;
    // As stored: 48 bytes of positions and 12 of indices; as floats: 10 attributes of 4 vertices.
    EXPECT_EQ(error_within({.attribute_bytes = 480}, builder), "no error");
    EXPECT_THAT(error_within({.attribute_bytes = 479}, builder), HasSubstr("limit attribute_bytes"));
}

TEST(GltfRefuse, more_vertices_or_triangles_than_the_limit_before_it_looks_at_a_byte) {
    GltfBuilder builder = square();
    builder.json["accessors"][0].erase("bufferView");
    builder.json["bufferViews"][1]["byteLength"] = 4096;  // wrong, but never looked at
    EXPECT_THAT(error_within({.vertices = 3}, builder), HasSubstr("limit vertices"));
    EXPECT_THAT(error_within({.triangles = 1}, builder), HasSubstr("limit triangles"));
}

TEST(GltfRefuse, more_objects_than_the_limit_of_whatever_kind) {
    for (const char* kind :
         {"scenes", "materials", "textures", "samplers", "skins", "cameras", "animations"}) {
        GltfBuilder builder = square();
        for (int i = 0; i < 20; ++i) builder.json[kind].push_back(Json::object());
        EXPECT_THAT(error_within({.objects = 20}, builder),
                    StartsWith("asset.too_large /" + std::string(kind)));
    }
    GltfBuilder builder = square();
    builder.json["animations"] = {{{"channels", Json::array()}, {"samplers", Json::array()}}};
    for (int i = 0; i < 20; ++i) builder.json["animations"][0]["channels"].push_back(Json::object());
    EXPECT_THAT(error_within({.objects = 20}, builder), HasSubstr("limit objects"));
}

TEST(GltfRefuse, more_buffer_views_than_accessors_may_be) {
    GltfBuilder builder = square();
    for (int i = 0; i < 20; ++i) builder.json["bufferViews"].push_back(Json::object());
    EXPECT_THAT(error_within({.accessors = 20}, builder), StartsWith("asset.too_large /bufferViews"));
}

TEST(GltfRefuse, more_values_of_json_than_the_limit) {
    EXPECT_THAT(error_within({.json_values = 20}, square()), HasSubstr("limit json_values"));
}

TEST(GltfRefuse, views_that_an_unknown_extension_may_mean_and_that_share_more_bytes_than_the_limit) {
    GltfBuilder builder = square();
    builder.json["extensionsUsed"] = {"X_indices"};
    builder.json["extensions"]["X_indices"] = {{"view", 1}};
    for (int i = 0; i < 100; ++i) builder.json["bufferViews"].push_back(builder.json["bufferViews"][0]);
    EXPECT_EQ(error_of(builder), "no error");
    EXPECT_THAT(error_within({.zip_bytes = 1000}, builder), HasSubstr("limit zip_bytes"));
}

// A Draco stream that ends after its counts, with the primitive around it.
std::string error_of_draco(const std::vector<uint8_t>& stream, const ReadLimits& limits = {}) {
    GltfBuilder builder = square();
    const size_t view = builder.json["bufferViews"].size();
    builder.add<uint8_t>(stream, 5121, "SCALAR", 1);
    builder.json["extensionsUsed"] = {"KHR_draco_mesh_compression"};
    builder.json["meshes"][0]["primitives"][0]["extensions"]["KHR_draco_mesh_compression"] = {
        {"bufferView", view}, {"attributes", {{"POSITION", 0}}}};
    return error_within(limits, builder);
}

// Version 2.2, triangles, edgebreaker or not, no flags.
std::vector<uint8_t> draco_header(bool edgebreaker) {
    return {'D', 'R', 'A', 'C', 'O', 2, 2, 1, static_cast<uint8_t>(edgebreaker), 0, 0};
}

TEST(GltfRefuse, a_draco_stream_that_claims_more_triangles_than_the_limit) {
    std::vector<uint8_t> edgebreaker = draco_header(true);
    edgebreaker.insert(edgebreaker.end(),
                       {0, 4, 0xFF, 0xFF, 0xFF, 0x7F, 0});  // 4 vertices, 268 million triangles
    EXPECT_THAT(error_of_draco(edgebreaker), HasSubstr("limit triangles"));
    std::vector<uint8_t> sequential = draco_header(false);
    sequential.insert(sequential.end(), {0xFF, 0xFF, 0xFF, 0x7F, 4});
    EXPECT_THAT(error_of_draco(sequential), HasSubstr("limit triangles"));
}

TEST(GltfRefuse, a_draco_stream_whose_attributes_would_take_more_than_the_limit) {
    std::vector<uint8_t> stream = draco_header(false);
    stream.insert(stream.end(), {1, 3, 1, 0, 1, 2});  // one triangle of three vertices, stored as it is
    stream.insert(stream.end(), {1, 1, 0, 10, 255, 0, 0, 0});  // one attribute of 255 numbers of 8 bytes each
    EXPECT_THAT(error_of_draco(stream), HasSubstr("cannot be decoded"));
    EXPECT_THAT(error_of_draco(stream, {.attribute_bytes = 6000}), HasSubstr("limit attribute_bytes"));
}

TEST(GltfRefuse, a_draco_stream_of_many_small_attributes_that_take_more_than_the_limit_while_it_is_decoded) {
    std::vector<uint8_t> stream = draco_header(false);
    constexpr uint8_t attributes = 100;
    stream.insert(stream.end(), {1, 3, 1, 0, 1, 2});  // one triangle of three vertices, stored as it is
    stream.insert(stream.end(), {1, attributes});
    for (uint8_t id = 0; id < attributes; ++id) stream.insert(stream.end(), {4, 2, 1, 0, id});  // one byte
    stream.insert(stream.end(), attributes, 1);  // as integers, which are decoded in 32 bits
    EXPECT_THAT(error_of_draco(stream), HasSubstr("cannot be decoded"));
    EXPECT_THAT(error_of_draco(stream, {.attribute_bytes = 2000}), HasSubstr("limit attribute_bytes"));
}

TEST(GltfRefuse, a_draco_stream_whose_seams_would_take_more_than_the_limit) {
    std::vector<uint8_t> stream = draco_header(true);
    stream.insert(stream.end(), {0, 4, 2, 255});  // 4 vertices, 2 triangles, 255 tables of seams
    EXPECT_THAT(error_of_draco(stream), HasSubstr("cannot be decoded"));
    EXPECT_THAT(error_of_draco(stream, {.attribute_bytes = 20000}), HasSubstr("limit attribute_bytes"));
}

TEST(GltfRefuse, a_draco_stream_of_a_method_that_is_unknown) {
    std::vector<uint8_t> stream = draco_header(false);
    stream[8] = 77;
    stream.insert(stream.end(), {1, 3, 1, 0, 1, 2});
    EXPECT_THAT(error_of_draco(stream), HasSubstr("is not a Draco stream of triangles"));
}

TEST(GltfRefuse, a_draco_stream_that_claims_more_vertices_than_its_accessors) {
    std::vector<uint8_t> edgebreaker = draco_header(true);
    edgebreaker.insert(edgebreaker.end(), {0, 0xFF, 0xFF, 0xFF, 0x7F, 2, 0});
    EXPECT_THAT(error_of_draco(edgebreaker), HasSubstr("4 vertices in its accessors"));
    std::vector<uint8_t> sequential = draco_header(false);
    sequential.insert(sequential.end(), {2, 0xFF, 0xFF, 0xFF, 0x7F});
    EXPECT_THAT(error_of_draco(sequential), HasSubstr("4 vertices in its accessors"));
}

TEST(GltfRefuse, a_place_with_a_slash_in_a_key_as_json_pointers_have_it) {
    GltfBuilder builder = square();
    builder.json["meshes"][0]["primitives"][0]["attributes"]["a/b~c"] = 0;
    EXPECT_THAT(error_of(builder), StartsWith("asset.malformed /meshes/0/primitives/0/attributes/a~1b~0c"));
}

// One of everything that a check looks at.
GltfBuilder square_with_everything() {
    GltfBuilder builder = square();
    const size_t times = builder.add<float>({0, 1}, 5126, "SCALAR", 1, {{"min", {0}}, {"max", {1}}});
    const size_t moves = builder.add<float>({0, 0, 0, 1, 1, 1}, 5126, "VEC3", 3);
    builder.json["animations"] = {
        {{"samplers", {{{"input", times}, {"output", moves}}}},
         {"channels", {{{"sampler", 0}, {"target", {{"node", 0}, {"path", "translation"}}}}}}}};
    builder.json["skins"] = {{{"joints", {0}}}};
    builder.json["materials"] = {{{"name", "red"}}};
    builder.json["extensionsUsed"] = {"EXT_mesh_gpu_instancing"};
    const size_t places = builder.add<float>({0, 0, 0, 5, 5, 5}, 5126, "VEC3", 3);
    builder.json["nodes"][0]["extensions"]["EXT_mesh_gpu_instancing"]["attributes"] = {
        {"TRANSLATION", places}};
    return builder;
}

TEST(GltfRefuse, stops_inside_of_every_check_when_it_is_told_to) {
    const std::string text = square_with_everything().gltf();
    struct Step {
        const char* name;
        std::function<void(gltf::Parsed&, const Watch&)> run;
    };
    using gltf::Parsed;
    const Step steps[] = {
        // in the order of read_gltf: each relies on those before
        {"parse_json",
         [&](Parsed& p, const Watch& watch) { p.json = gltf::parse_json(as_bytes(text), {}, watch); }},
        {"check_schema", [](Parsed& p, const Watch& watch) { gltf::check_schema(p.json, watch); }},
        {"check_claims", [](Parsed& p, const Watch& watch) { gltf::check_claims(p.json, {}, watch); }},
        {"check_extensions", [](Parsed& p, const Watch& watch) { gltf::check_extensions(p, watch); }},
        {"check_nodes", [](Parsed& p, const Watch& watch) { gltf::check_nodes(p, {}, watch); }},
        {"read_buffers", [](Parsed& p, const Watch& watch) { gltf::read_buffers(p, Resources(), watch); }},
        {"read_views", [](Parsed& p, const Watch& watch) { gltf::read_views(p, {}, watch); }},
        {"read_accessors", [](Parsed& p, const Watch& watch) { gltf::read_accessors(p, {}, watch); }},
        {"check_meshes", [](Parsed& p, const Watch& watch) { gltf::check_meshes(p, watch); }},
        {"check_skins", [](Parsed& p, const Watch& watch) { gltf::check_skins(p, {}, watch); }},
        {"check_animations", [](Parsed& p, const Watch& watch) { gltf::check_animations(p, watch); }},
        {"check_instancing", [](Parsed& p, const Watch& watch) { gltf::check_instancing(p, watch); }},
        {"check_materials", [](Parsed& p, const Watch& watch) { gltf::check_materials(p, watch); }},
        {"check_vertex_data", [](Parsed& p, const Watch& watch) { gltf::check_vertex_data(p, {}, watch); }},
        {"check_accessor_data", [](Parsed& p, const Watch& watch) { gltf::check_accessor_data(p, watch); }},
    };
    std::stop_source source;
    source.request_stop();
    const Watch stopped{.stop = source.get_token()};
    gltf::Parsed parsed;
    for (const auto& [name, run] : steps) {
        EXPECT_THAT(error_of([&, &step = run] { step(parsed, stopped); }), StartsWith("job.cancelled"))
            << name;
        ASSERT_EQ(error_of([&, &step = run] { step(parsed, {}); }), "no error") << name;
    }
}

}  // namespace

}  // namespace coppice
