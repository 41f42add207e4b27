// Small real files, cut short at many places and with single bytes changed.
#include <gtest/gtest.h>

#include "tests/support/damage.h"
#include "tests/support/test_assets.h"

namespace coppice::test {
namespace {

class SmallFiles : public ::testing::TestWithParam<std::string> {};

TEST_P(SmallFiles, cut_short_or_changed_are_refused_or_read) {
    if (!asset_folder()) GTEST_SKIP() << no_assets_message();
    const UploadedAsset asset = load_asset(GetParam());
    ASSERT_TRUE(reads_or_refuses(asset.upload()));
    EXPECT_TRUE(survives_truncation(asset.upload(), 150));
    EXPECT_TRUE(survives_mutation(asset.upload(), 400, 1, 4096));
}

INSTANTIATE_TEST_SUITE_P(
    Assets, SmallFiles,
    ::testing::Values("duplicates/Cubes.glb", "duplicates/no_indices_3storybuilding.glb",
                      "features/BoxInterleaved.glb", "features/BoxMeshopt.glb", "features/box_sparse.glb",
                      "features/singleBlendshapeCube_sparse.glb",
                      "instanced/3d-tiles-tools/InstancedAxesSimple/instancedAxesSimple.gltf",
                      "instanced/CubeScaledInstances/cube_att.gltf", "textured/BoxVertexColors.glb",
                      "features/Duck-draco/Duck.gltf", "textured/obj2gltf/box-groups/box-groups.obj",
                      "textured/fuze.obj", "models/fox.ply", "models/apple.ply",
                      "textured/cube_blender_uv.ply"),
    [](const auto& given) { return test_name(given.param); });

}  // namespace
}  // namespace coppice::test
