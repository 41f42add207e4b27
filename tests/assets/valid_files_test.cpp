// Every valid file of the assets, in each format that is read, becomes glTF without an error in Khronos'
// validator.
#include <gtest/gtest.h>

#include <map>

#include "core/base/error.h"
#include "core/base/parallel.h"
#include "core/optimize/optimize.h"
#include "tests/support/gltf_validator.h"
#include "tests/support/test_assets.h"

namespace coppice::test {
namespace {

class ValidFolders : public ::testing::TestWithParam<std::tuple<std::string, Format>> {};

TEST_P(ValidFolders, become_glTF_that_the_validator_passes) {
    const auto& [folder, format] = GetParam();
    if (!asset_folder()) GTEST_SKIP() << no_assets_message();
    const std::vector<std::string> files =
        asset_files(folder, {".glb", ".gltf", ".obj", ".iobj", ".ply", ".stl", ".i3dm", ".dae"});
    ASSERT_FALSE(files.empty());
    const std::map<std::string, std::string> refused = refused_files();

    std::vector<std::optional<WrittenAsset>> results(files.size());
    std::vector<std::string> problems(files.size());
    std::vector<std::string> messages(files.size());
    parallel_for(files.size(), 2, [&, &output_format = format](size_t i) {
        try {
            const UploadedAsset asset = load_asset(files[i]);
            OptimizeOptions options;
            options.ratio = 0.5;
            options.format = output_format;
            options.threads = 1;
            results[i] = optimize(asset.upload(), options, {}, {}).asset;
        } catch (const Error& error) {
            problems[i] = name(error.code());
            messages[i] = error.message() + " at " + error.where();
        }
    });

    ValidatorBatch batch;
    for (size_t i = 0; i < files.size(); ++i) {
        const auto expected = refused.find(files[i]);
        EXPECT_EQ(problems[i], expected == refused.end() ? "" : expected->second)
            << files[i] << ": " << messages[i];
        if (results[i]) batch.add(files[i], *results[i]);
    }
    EXPECT_TRUE(batch.has_no_errors());
}

INSTANTIATE_TEST_SUITE_P(Assets, ValidFolders,
                         ::testing::Combine(::testing::Values("models", "textured", "instanced", "duplicates",
                                                              "features"),
                                            ::testing::Values(Format::glb, Format::gltf)),
                         [](const auto& given) {
                             return std::get<0>(given.param) + "_as_" +
                                    std::string(id(std::get<1>(given.param)));
                         });

// A row that no longer has a file would hide a mistake in a name.
TEST(RefusedFiles, are_there) {
    if (!asset_folder()) GTEST_SKIP() << no_assets_message();
    for (const auto& [file, code] : refused_files())
        EXPECT_TRUE(std::filesystem::exists(*asset_folder() / file)) << file;
}

}  // namespace
}  // namespace coppice::test
