#include "proto/comparison.h"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

namespace coppice {
namespace {

using nlohmann::json;

TEST(Comparison, has_lengths_in_model_units_and_as_fractions_of_the_diagonal) {
    Comparison comparison;
    comparison.scenes.diagonal = 4;
    comparison.scenes.surface.symmetric = {.largest = 2, .mean = 0.5, .root_mean_square = 1};
    const json distance =
        json::parse(print_comparison(comparison))["surface"]["surface_distance"]["symmetric"];
    EXPECT_EQ(distance["largest_model_units"], 2);
    EXPECT_EQ(distance["largest_diagonal_fraction"], 0.5);
    EXPECT_EQ(distance["mean_diagonal_fraction"], 0.125);
    EXPECT_EQ(distance["rms_diagonal_fraction"], 0.25);
}

TEST(Comparison, has_null_for_what_is_not_there_and_was_not_asked_for) {
    const json printed = json::parse(print_comparison({}));
    EXPECT_TRUE(printed["surface"]["normal_deviation"].is_null());
    EXPECT_TRUE(printed["surface"]["texture_coordinate_deviation"].is_null());
    EXPECT_TRUE(printed["surface"]["color_deviation"].is_null());
    EXPECT_TRUE(printed["elements"]["candidate"]["self_intersections"].is_null());
    EXPECT_EQ(printed["measured"], "expanded");
    EXPECT_EQ(printed["meshes"], json::array());
}

TEST(Comparison, lists_each_mesh_in_its_own_units) {
    Comparison comparison;
    comparison.scenes.is_by_mesh = true;
    comparison.scenes.diagonal = 4;
    comparison.scenes.meshes = {{.name = "oak", .instances = 3, .largest_scale = 2, .surface = {}}};
    comparison.scenes.meshes[0].surface.symmetric.largest = 0.25;
    comparison.scenes.meshes[0].surface.normals = AngleSpread{.largest = 90, .mean = 1, .percentile_95 = 10};
    const json printed = json::parse(print_comparison(comparison));
    EXPECT_EQ(printed["measured"], "meshes");
    const json mesh = printed["meshes"][0];
    EXPECT_EQ(mesh["name"], "oak");
    EXPECT_EQ(mesh["largest_scale"], 2);
    const json distance = mesh["surface"]["surface_distance"]["symmetric"];
    EXPECT_EQ(distance["largest_model_units"], 0.25);
    EXPECT_FALSE(distance.contains("largest_diagonal_fraction"));
    EXPECT_EQ(mesh["surface"]["normal_deviation"]["percentile_95_degrees"], 10);
}

}  // namespace
}  // namespace coppice
