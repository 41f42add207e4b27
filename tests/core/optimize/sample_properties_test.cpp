// The procedural samples in their full size, as GLB and as instanced OBJ, simplified to 0.9, 0.8 and 0.5: see
// tests/support/properties.h for what must hold.
#include <gtest/gtest.h>

#include "core/optimize/optimize.h"
#include "core/sample/sample.h"
#include "tests/support/properties.h"

namespace coppice::test {
namespace {

using SampleAndRatio = std::tuple<std::string, double, Format>;

class Samples : public ::testing::TestWithParam<SampleAndRatio> {};

std::vector<std::string> sample_names() {
    std::vector<std::string> names;
    for (const SampleKind& kind : sample_kinds()) names.emplace_back(kind.name);
    return names;
}

Scene read_back(const WrittenAsset& asset) {
    return read_asset({.asset = {.path = "result." + asset.file_extension, .bytes = asset.bytes}}, {}, {})
        .scene;
}

TEST_P(Samples, keep_their_properties_when_simplified) {
    const auto& [name, ratio, format] = GetParam();
    const WrittenAsset source = write_asset(make_sample(name, {}), {.format = format}, {});
    const Upload upload = {.asset = {.path = "sample." + source.file_extension, .bytes = source.bytes}};
    const Scene before = read_asset(upload, {}, {}).scene;

    OptimizeOptions options;
    options.ratio = ratio;
    options.format = format;
    options.threads = 2;
    const Optimized result = optimize(upload, options, {}, {});
    expect_properties_kept(before, read_back(result.asset), result.report, ratio);

    for (const unsigned threads : {1U, 7U}) {
        options.threads = threads;
        EXPECT_EQ(optimize(upload, options, {}, {}).asset.bytes, result.asset.bytes) << threads << " threads";
    }
}

INSTANTIATE_TEST_SUITE_P(All, Samples,
                         ::testing::Combine(::testing::ValuesIn(sample_names()),
                                            ::testing::Values(0.9, 0.8, 0.5),
                                            ::testing::Values(Format::glb, Format::iobj)),
                         [](const auto& given) {
                             const auto percent = static_cast<int>(100 * std::get<1>(given.param) + 0.5);
                             return std::get<0>(given.param) + "_at_" + std::to_string(percent) + "_as_" +
                                    std::string(id(std::get<2>(given.param)));
                         });

}  // namespace
}  // namespace coppice::test
