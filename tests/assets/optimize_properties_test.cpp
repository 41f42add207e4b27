// Instanced and repeated real scenes, simplified to 0.9, 0.8 and 0.5: see tests/support/properties.h for what
// must hold.
#include <gtest/gtest.h>

#include "core/optimize/optimize.h"
#include "core/scene/instance.h"
#include "tests/support/properties.h"
#include "tests/support/test_assets.h"

namespace coppice::test {
namespace {

using FileAndRatio = std::tuple<std::string, double>;

class InstancedAssets : public ::testing::TestWithParam<FileAndRatio> {};

std::vector<std::string> instanced_files() {
    std::vector<std::string> files = gltf2_files("instanced");
    for (std::string& file : gltf2_files("duplicates")) files.push_back(std::move(file));
    const auto refused = refused_files();
    std::erase_if(files, [&](const std::string& file) { return refused.contains(file); });
    return files;
}

TEST_P(InstancedAssets, keep_their_properties_when_simplified) {
    const auto& [file, ratio] = GetParam();
    const UploadedAsset asset = load_asset(file);
    const Scene before = read_asset(asset.upload(), {}, {}).scene;
    ASSERT_GT(instance_count(before), 0U);

    OptimizeOptions options;
    options.algorithm = "its";
    options.ratio = ratio;
    options.format = Format::glb;
    options.threads = 2;
    const Optimized result = optimize(asset.upload(), options, {}, {});
    const Scene after =
        read_asset({.asset = {.path = "result.glb", .bytes = result.asset.bytes}}, {}, {}).scene;
    expect_properties_kept(before, after, result.report, ratio);

    for (const unsigned threads : {1U, 7U}) {
        options.threads = threads;
        EXPECT_EQ(optimize(asset.upload(), options, {}, {}).asset.bytes, result.asset.bytes)
            << threads << " threads";
    }
}

INSTANTIATE_TEST_SUITE_P(Assets, InstancedAssets,
                         ::testing::Combine(::testing::ValuesIn(instanced_files()),
                                            ::testing::Values(0.9, 0.8, 0.5)),
                         [](const auto& given) {
                             const auto percent = static_cast<int>(100 * std::get<1>(given.param) + 0.5);
                             return test_name(std::get<0>(given.param)) + "_at_" + std::to_string(percent);
                         });
GTEST_ALLOW_UNINSTANTIATED_PARAMETERIZED_TEST(InstancedAssets);

// So that the label has a test where there are no assets, and one that says so.
TEST(InstancedAssetsFolder, holds_glTF_files) {
    if (!asset_folder()) GTEST_SKIP() << no_assets_message();
    EXPECT_GE(instanced_files().size(), 12U);
}

}  // namespace
}  // namespace coppice::test
