#include "proto/report.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "core/simplify/registry.h"

namespace coppice {
namespace {

using nlohmann::json;

Report two_oaks() {
    Report report;
    report.algorithm = "its";
    report.parameters = ParameterValues::parse(default_algorithm().parameters, {});
    report.input = {.bytes = 2000,
                    .format = Format::iobj,
                    .meshes = 1,
                    .instances = 2,
                    .unique_triangles = 100,
                    .rendered_triangles = 200};
    report.output = {.bytes = 1000,
                     .format = Format::glb,
                     .meshes = 1,
                     .instances = 2,
                     .unique_triangles = 50,
                     .rendered_triangles = 100};
    report.timing_ms = {.read = 1, .simplify = 2.5, .write = 0.5, .total = 4};
    report.meshes = {{.name = "oak",
                      .instances = 2,
                      .triangles_in = 100,
                      .triangles_out = 50,
                      .error_model_units = 0.25,
                      .error_diagonal_fraction = 0.125,
                      .stop_reason = StopReason::target}};
    report.savings = {.bytes_ratio = 0.5, .bytes_vs_expanded = 0.25, .bytes_saved_by_instancing = 900};
    report.instancing = {.given = 2,
                         .discovered = 0,
                         .unique = 1,
                         .map = {{.node = 3, .mesh = 0, .instance = 1}},
                         .pruned = {{.node = 4, .instance = 0}}};
    report.warnings = {{.code = "mesh.degenerate", .message = "2 triangles have no area", .where = "oak"}};
    report.engine_version = "0.1.0";
    report.engine_build = "abc";
    return report;
}

TEST(Report, has_the_names_of_the_contract) {
    const json report = json::parse(print_report(two_oaks()));
    EXPECT_EQ(report["algorithm"]["id"], "its");
    EXPECT_EQ(report["input"]["format"], "iobj");
    EXPECT_EQ(report["output"]["rendered_triangles"], 100);
    EXPECT_EQ(report["timing_ms"]["simplify"], 2.5);
    EXPECT_EQ(report["meshes"][0],
              json::parse(R"({"name":"oak","instances":2,"triangles_in":100,"triangles_out":50,
                              "error_model_units":0.25,"error_diagonal_fraction":0.125,"certified":false,
                              "stop_reason":"target"})"));
    EXPECT_EQ(report["savings"]["bytes_vs_expanded"], 0.25);
    EXPECT_EQ(report["instancing"], json::parse(R"({"given":2,"discovered":0,"unique":1,
                                                    "map":[{"node":3,"mesh":0,"instance":1}],
                                                    "pruned":[{"node":4,"instance":0}]})"));
    EXPECT_EQ(report["warnings"][0]["where"], "oak");
    EXPECT_EQ(report["engine"]["version"], "0.1.0");
}

TEST(Report, tells_the_parameters_that_were_used_with_their_defaults) {
    EXPECT_EQ(json::parse(print_report(two_oaks()))["algorithm"]["parameters"]["mode"], "full");
}

TEST(Report, prints_names_that_are_not_utf_8) {
    Report report = two_oaks();
    report.meshes[0].name = "Eiche \xe4";
    EXPECT_EQ(json::parse(print_report(report))["meshes"][0]["name"], "Eiche \xEF\xBF\xBD");
}

TEST(Report, of_an_inspection_has_the_box_of_the_scene) {
    Inspection inspection;
    inspection.bounds.extend(Vec3d{0, 0, 0});
    inspection.bounds.extend(Vec3d{1, 2, 3});
    inspection.meshes = {{.name = "oak", .instances = 2, .attributes = {"NORMAL"}, .border_edges = 4}};
    const json printed = json::parse(print_inspection(inspection));
    EXPECT_EQ(printed["bounds"], json::parse(R"({"min":[0,0,0],"max":[1,2,3]})"));
    EXPECT_EQ(printed["meshes"][0]["attributes"], json::parse(R"(["NORMAL"])"));
    EXPECT_EQ(printed["meshes"][0]["border_edges"], 4);
}

TEST(Report, of_an_empty_scene_has_no_box) {
    EXPECT_TRUE(json::parse(print_inspection({}))["bounds"].is_null());
}

TEST(Report, lists_every_algorithm_with_its_parameters) {
    const json printed = json::parse(print_algorithms());
    EXPECT_EQ(printed["default_algorithm"], default_algorithm().id);
    ASSERT_EQ(printed["algorithms"].size(), algorithms().size());
    const json& listed = printed["algorithms"];
    const auto is_its = [](const json& algorithm) { return algorithm["id"] == "its"; };
    const auto found = std::find_if(listed.begin(), listed.end(), is_its);
    ASSERT_NE(found, listed.end());
    const json& its = *found;
    EXPECT_FALSE(its["citation"].get<std::string>().empty());
    const json& mode = its["parameters"][0];
    EXPECT_EQ(mode["id"], "mode");
    EXPECT_EQ(mode["type"], "choice");
    EXPECT_EQ(mode["choices"], json::parse(R"(["full","faithful"])"));
    EXPECT_EQ(mode["default"], "full");
}

TEST(Report, prints_whole_numbers_as_whole_numbers) {
    const json printed = json::parse(print_algorithms());
    size_t seen = 0;
    for (const json& algorithm : printed["algorithms"]) {
        for (const json& parameter : algorithm["parameters"]) {
            if (parameter["type"] != "integer") continue;
            for (const char* part : {"default", "minimum", "maximum"}) {
                if (!parameter.contains(part)) continue;
                EXPECT_TRUE(parameter[part].is_number_integer()) << parameter;
                ++seen;
            }
        }
    }
    EXPECT_GT(seen, 0U);
}

}  // namespace
}  // namespace coppice
