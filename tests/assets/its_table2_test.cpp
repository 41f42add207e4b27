// Table 2 of the ITS paper on a bunny of the same size as its own: 2503 vertices, 4968 triangles.
#include <gtest/gtest.h>

#include <string>
#include <tuple>

#include "core/format/asset.h"
#include "core/simplify/registry.h"
#include "tests/support/test_assets.h"

namespace coppice::test {
namespace {

struct Row {
    double removed;
    double vertices, triangles;  // as printed
};

class ItsTable2OfTheBunny : public testing::TestWithParam<std::tuple<std::string, Row>> {};

TEST_P(ItsTable2OfTheBunny, leaves_as_many_vertices_and_triangles_as_printed) {
    if (!asset_folder()) GTEST_SKIP() << no_assets_message();
    const UploadedAsset asset = load_asset("models/bunny-2503.obj");
    const Scene scene = read_asset(asset.upload(), {}, Watch{}).scene;
    ASSERT_EQ(scene.meshes.size(), 1U);
    ASSERT_EQ(scene.meshes[0].vertex_count(), 2503U);
    ASSERT_EQ(scene.meshes[0].triangle_count(), 4968U);

    const auto& [mode, row] = GetParam();
    const Algorithm& its = find_algorithm("its");
    const Target target = {.vertices = static_cast<uint64_t>(2503 * (1 - row.removed))};
    const Simplified s = its.simplify(scene.meshes[0], {}, target,
                                      ParameterValues::parse(its.parameters, {{"mode", mode}}), Watch{});
    EXPECT_EQ(s.stop_reason, StopReason::target);
    EXPECT_NEAR(static_cast<double>(s.mesh.vertex_count()), row.vertices, 0.02 * row.vertices);
    EXPECT_NEAR(static_cast<double>(s.mesh.triangle_count()), row.triangles, 0.06 * row.triangles);
}

INSTANTIATE_TEST_SUITE_P(Its, ItsTable2OfTheBunny,
                         testing::Combine(testing::Values("full", "faithful"),
                                          testing::Values(Row{0.1, 2247, 4456}, Row{0.2, 1998, 3958},
                                                          Row{0.5, 1244, 2448})));

}  // namespace
}  // namespace coppice::test
