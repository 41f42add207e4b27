// What the clustering algorithms of Li and Kim leave of known meshes as they are printed. The paper gives no
// counts: these were computed once by small programs of their own.
#include <gtest/gtest.h>

#include <string>

#include "core/format/asset.h"
#include "core/simplify/registry.h"
#include "tests/support/test_assets.h"

namespace coppice::test {
namespace {

struct Expected {
    const char* asset;
    const char* algorithm;
    std::map<std::string, ParameterValue> parameters;
    double vertices, triangles;
};

std::ostream& operator<<(std::ostream& out, const Expected& e) {
    out << e.asset << ' ' << e.algorithm;
    return out;
}

class LiKim2020 : public testing::TestWithParam<Expected> {};

TEST_P(LiKim2020, leaves_as_many_vertices_and_triangles_as_expected) {
    if (!asset_folder()) GTEST_SKIP() << no_assets_message();
    const UploadedAsset asset = load_asset(GetParam().asset);
    const Scene scene = read_asset(asset.upload(), {}, Watch{}).scene;
    ASSERT_EQ(scene.meshes.size(), 1U);
    const Algorithm& a = find_algorithm(GetParam().algorithm);
    const Simplified s = a.simplify(scene.meshes[0], {}, {},
                                    ParameterValues::parse(a.parameters, GetParam().parameters), Watch{});
    const auto vertices = static_cast<double>(s.mesh.vertex_count());
    const auto triangles = static_cast<double>(s.mesh.triangle_count());
    EXPECT_NEAR(vertices, GetParam().vertices, 0.03 * GetParam().vertices);
    EXPECT_NEAR(triangles, GetParam().triangles, 0.03 * GetParam().triangles);
}

const std::map<std::string, ParameterValue> vt = {{"circumcenter", "paper"}, {"passes", 1.0}};

std::map<std::string, ParameterValue> ivdd(double distance, const char* mode) {
    return {{"circumcenter", "paper"}, {"distance", distance}, {"mode", mode}};
}

std::map<std::string, ParameterValue> ss(double radius) {
    return {{"neighborhood", "euclidean"}, {"radius", radius}};
}

constexpr const char* bunny = "models/stanford-bunny.obj";

INSTANTIATE_TEST_SUITE_P(Bunny, LiKim2020,
                         testing::Values(Expected{bunny, "vt", vt, 15426, 30680},
                                         Expected{bunny, "ivdd", ivdd(0.8, "once"), 20421, 40687},
                                         Expected{bunny, "ivdd", ivdd(0.8, "sequential"), 19989, 39827},
                                         Expected{bunny, "ivdd", ivdd(1.0, "once"), 17330, 34497},
                                         Expected{bunny, "ivdd", ivdd(1.0, "sequential"), 13287, 26431},
                                         Expected{bunny, "ss", ss(0.8), 18363, 36582},
                                         Expected{bunny, "ss", ss(1.0), 15340, 30467}));
INSTANTIATE_TEST_SUITE_P(Others, LiKim2020,
                         testing::Values(Expected{"models/cow.obj", "vt", vt, 1259, 2511},
                                         Expected{"models/suzanne.obj", "vt", vt, 235, 434},
                                         Expected{"models/cow.obj", "ss", ss(1.0), 965, 1944}));

}  // namespace
}  // namespace coppice::test
