// Table 1 of Li and Kim 2019, each of its numbers divided by three: see surface_angle.h.
#include <gtest/gtest.h>

#include <string>

#include "core/format/asset.h"
#include "core/simplify/registry.h"
#include "tests/support/test_assets.h"

namespace coppice::test {
namespace {

struct Row {
    double angle;
    double triangles;  // as printed
};

class LiKim2019Table1 : public testing::TestWithParam<Row> {};

TEST_P(LiKim2019Table1, leaves_as_many_triangles_as_printed) {
    if (!asset_folder()) GTEST_SKIP() << no_assets_message();
    const UploadedAsset asset = load_asset("models/suzanne.obj");
    const Mesh monkey = read_asset(asset.upload(), {}, {}).scene.meshes.front();
    ASSERT_EQ(monkey.vertex_count(), 1521U / 3 - 2);  // two are equal to others, and welded
    ASSERT_EQ(monkey.triangle_count(), 2904U / 3);
    const Algorithm& a = find_algorithm("surface-angle");
    const ParameterValues values = ParameterValues::parse(
        a.parameters, {{"angle", GetParam().angle}, {"stitch", "paper"}, {"borders", "remove"}});
    const Simplified s = a.simplify(monkey, {}, {}, values, Watch{});
    EXPECT_NEAR(static_cast<double>(s.mesh.triangle_count()), GetParam().triangles / 3, 10);
}

INSTANTIATE_TEST_SUITE_P(Monkey, LiKim2019Table1,
                         testing::Values(Row{30, 2562}, Row{60, 2574}, Row{120, 2691}, Row{150, 2832}),
                         [](const auto& row) { return "at_" + std::to_string(int(row.param.angle)); });

}  // namespace
}  // namespace coppice::test
