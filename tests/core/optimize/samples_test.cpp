// What has to hold for every sample at every ratio, from bytes to bytes.
#include <gmock/gmock.h>

#include <string>
#include <tuple>

#include "core/optimize/optimize.h"
#include "core/sample/sample.h"
#include "core/scene/instance.h"
#include "tests/support/properties.h"

namespace coppice {
namespace {

// Small enough to be quick, large enough that collapses meet seams, borders and each other.
Bytes sample_bytes(const std::string& name) {
    const SampleOptions options =
        name == "bunny13" ? SampleOptions{} : SampleOptions{.copies = 12, .triangles = 600};
    return write_asset(make_sample(name, options), {}, {}).bytes;
}

Upload upload_of(ByteView bytes) {
    return {.asset = {.path = "sample.glb", .bytes = bytes}};
}

Scene read(ByteView bytes) {
    return read_asset(upload_of(bytes), {}, {}).scene;
}

std::vector<std::string> names() {
    std::vector<std::string> out;
    for (const SampleKind& kind : sample_kinds()) out.emplace_back(kind.name);
    return out;
}

class SampleAtRatio : public testing::TestWithParam<std::tuple<std::string, int>> {};

INSTANTIATE_TEST_SUITE_P(Optimize, SampleAtRatio,
                         testing::Combine(testing::ValuesIn(names()), testing::Values(90, 80, 50)),
                         [](const auto& test) {
                             return std::get<0>(test.param) + "_" + std::to_string(std::get<1>(test.param));
                         });

TEST_P(SampleAtRatio, keeps_what_has_to_be_kept) {
    const auto [name, percent] = GetParam();
    const double ratio = percent / 100.0;
    const Bytes bytes = sample_bytes(name);
    const Optimized result = optimize(upload_of(bytes), {.ratio = ratio}, {}, {});
    test::expect_properties_kept(read(bytes), read(result.asset.bytes), result.report, ratio);
}

class EverySampleOptimized : public testing::TestWithParam<std::string> {};

INSTANTIATE_TEST_SUITE_P(Optimize, EverySampleOptimized, testing::ValuesIn(names()),
                         [](const auto& test) { return test.param; });

TEST_P(EverySampleOptimized, has_the_same_bytes_with_any_number_of_threads) {
    const Bytes bytes = sample_bytes(GetParam());
    const Bytes one = optimize(upload_of(bytes), {.threads = 1}, {}, {}).asset.bytes;
    EXPECT_TRUE(one == optimize(upload_of(bytes), {.threads = 2}, {}, {}).asset.bytes);
    EXPECT_TRUE(one == optimize(upload_of(bytes), {.threads = 7}, {}, {}).asset.bytes);
}

TEST_P(EverySampleOptimized, comes_back_from_every_format_it_is_written_in) {
    const Bytes bytes = sample_bytes(GetParam());
    const Scene before = read(bytes);
    for (const Format format : {Format::glb, Format::gltf, Format::iobj, Format::obj}) {
        SCOPED_TRACE(id(format));
        const Optimized result = optimize(upload_of(bytes), {.ratio = 1, .format = format}, {}, {});
        const ReadAsset after = read_asset({.asset = {.path = "", .bytes = result.asset.bytes}}, {}, {});
        EXPECT_EQ(instance_count(after.scene), instance_count(before));
        EXPECT_TRUE(test::keeps_bounds(before, after.scene, 1e-5));
        const AssetSummary read_again = summarize(after.scene, format, result.asset.bytes.size());
        EXPECT_EQ(read_again.rendered_triangles, result.report.input.rendered_triangles);
        EXPECT_EQ(read_again.unique_triangles, result.report.output.unique_triangles);
        EXPECT_EQ(read_again.meshes, result.report.output.meshes);
        EXPECT_EQ(read_again.texture_bytes, result.report.input.texture_bytes);
    }
}

// users.md 4: an already instanced file was corrupted by a second pass.
TEST_P(EverySampleOptimized, does_not_change_when_nothing_is_taken_away) {
    const Bytes once = optimize(upload_of(sample_bytes(GetParam())), {.ratio = 1}, {}, {}).asset.bytes;
    EXPECT_TRUE(once == optimize(upload_of(once), {.ratio = 1}, {}, {}).asset.bytes);
}

}  // namespace
}  // namespace coppice
