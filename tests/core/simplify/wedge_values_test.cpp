#include "core/simplify/wedge_values.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <utility>

namespace coppice {
namespace {

using testing::ElementsAre;
using testing::FloatNear;
using testing::Pointwise;

// Two wedges with one attribute.
Mesh with(std::string name, uint32_t components, std::vector<float> values) {
    Mesh mesh;
    mesh.positions.resize(1);
    mesh.wedge_vertex.assign(values.size() / components, 0);
    mesh.attributes.push_back(
        {.name = std::move(name), .components = components, .values = std::move(values)});
    return mesh;
}

const std::vector<uint32_t> two = {0, 1};

// What wedge 0 has after it was made of so much of both.
std::vector<float> mixed(const Mesh& mesh, double of_first, double of_second) {
    WedgeValues values(mesh, two);
    const std::vector<WedgeShare> shares = {{0, of_first}, {1, of_second}};
    values.blend(shares, 0);
    Mesh result = mesh;
    values.write(std::vector<uint32_t>{0}, result);
    std::vector<float> all;
    for (const Attribute& a : result.attributes) all.insert(all.end(), a.values.begin(), a.values.end());
    return all;
}

TEST(WedgeValues, are_those_of_the_source_until_blended) {
    const Mesh mesh = with("TEXCOORD_0", 2, {0, 0, 1, 2});
    const WedgeValues values(mesh, two);
    EXPECT_EQ(values.value(1, 0, 1), 2);
}

TEST(WedgeValues, mix_texture_coordinates_linearly) {
    EXPECT_THAT(mixed(with("TEXCOORD_0", 2, {0, 0, 1, 2}), 0.75, 0.25), ElementsAre(0.25F, 0.5F));
}

TEST(WedgeValues, keep_normals_at_unit_length) {
    EXPECT_THAT(mixed(with("NORMAL", 3, {1, 0, 0, 0, 1, 0}), 0.5, 0.5),
                Pointwise(FloatNear(1e-6F), {0.70710678F, 0.70710678F, 0.F}));
}

TEST(WedgeValues, take_the_normal_of_the_larger_share_where_two_cancel) {
    EXPECT_THAT(mixed(with("NORMAL", 3, {0, 0, 1, 0, 0, -1}), 0.5, 0.5), ElementsAre(0, 0, 1));
}

TEST(WedgeValues, never_mix_the_handedness_of_tangents) {
    EXPECT_THAT(mixed(with("TANGENT", 4, {1, 0, 0, 1, 1, 0, 0, -1}), 0.4, 0.6), ElementsAre(1, 0, 0, -1));
}

TEST(WedgeValues, never_mix_custom_values) {
    EXPECT_THAT(mixed(with("_ID", 1, {3, 8}), 0.6, 0.4), ElementsAre(3));
}

TEST(WedgeValues, sum_skin_weights_by_joint_and_keep_the_strongest) {
    Mesh mesh = with("JOINTS_0", 4, {0, 1, 2, 3, 1, 4, 5, 0});
    mesh.attributes.push_back(
        {.name = "WEIGHTS_0", .components = 4, .values = {0.4F, 0.3F, 0.2F, 0.1F, 0.5F, 0.3F, 0.2F, 0}});
    const std::vector<float> values = mixed(mesh, 0.5, 0.5);
    // Joint 1: 0.15 + 0.25; 0: 0.2; 4: 0.15; 2 and 5: 0.1 each, of which the lower stays; 3: 0.05.
    const double kept = 0.4 + 0.2 + 0.15 + 0.1;
    EXPECT_THAT(std::vector<float>(values.begin(), values.begin() + 4), ElementsAre(1, 0, 4, 2));
    EXPECT_THAT(std::vector<float>(values.begin() + 4, values.end()),
                Pointwise(testing::FloatNear(1e-6F),
                          {static_cast<float>(0.4 / kept), static_cast<float>(0.2 / kept),
                           static_cast<float>(0.15 / kept), static_cast<float>(0.1 / kept)}));
}

TEST(WedgeValues, mix_morph_deltas_linearly) {
    Mesh mesh = with("TEXCOORD_0", 2, {0, 0, 1, 1});
    mesh.morph_targets.push_back(
        {.deltas = {{.name = "POSITION", .components = 3, .values = {0, 0, 0, 4, 0, 0}}}});
    WedgeValues values(mesh, two);
    const std::vector<WedgeShare> shares = {{0, 0.75}, {1, 0.25}};
    values.blend(shares, 1);
    Mesh result = mesh;
    values.write(std::vector<uint32_t>{1, 0}, result);
    EXPECT_THAT(result.morph_targets[0].deltas[0].values, ElementsAre(1, 0, 0, 0, 0, 0));
}

TEST(WedgeValues, blend_what_was_blended_before) {
    const Mesh mesh = with("COLOR_0", 3, {0, 0, 0, 1, 1, 1});
    WedgeValues values(mesh, two);
    const std::vector<WedgeShare> halves = {{0, 0.5}, {1, 0.5}};
    values.blend(halves, 0);
    values.blend(halves, 0);
    EXPECT_EQ(values.value(0, 0, 0), 0.75F);
}

}  // namespace
}  // namespace coppice
