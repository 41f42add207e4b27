// Every glTF that is written from a sample, in each way of instancing, has no error in Khronos' validator.
#include <fmt/core.h>
#include <gtest/gtest.h>

#include "core/optimize/optimize.h"
#include "core/sample/sample.h"
#include "tests/support/gltf_validator.h"

namespace coppice::test {
namespace {

TEST(SamplesValidate, as_written_and_when_simplified) {
    ValidatorBatch batch;
    for (const SampleKind& kind : sample_kinds())
        for (const Format format : {Format::glb, Format::gltf}) {
            const WrittenAsset source = write_asset(make_sample(kind.name, {}), {.format = format}, {});
            batch.add(fmt::format("{}.{}", kind.name, id(format)), source);
            const Upload upload = {
                .asset = {.path = "sample." + source.file_extension, .bytes = source.bytes}};
            for (const double ratio : {0.9, 0.8, 0.5}) {
                OptimizeOptions options;
                options.ratio = ratio;
                options.format = format;
                batch.add(fmt::format("{} at {} as {}", kind.name, ratio, id(format)),
                          optimize(upload, options, {}, {}).asset);
            }
        }
    EXPECT_TRUE(batch.has_no_errors());
}

TEST(SamplesValidate, in_each_way_of_instancing) {
    ValidatorBatch batch;
    for (const SampleKind& kind : sample_kinds()) {
        const WrittenAsset source = write_asset(make_sample(kind.name, {}), {.format = Format::iobj}, {});
        const Upload upload = {.asset = {.path = "sample." + source.file_extension, .bytes = source.bytes}};
        for (const Instancing instancing : {Instancing::nodes, Instancing::expand}) {
            OptimizeOptions options;
            options.format = Format::glb;
            options.instancing = instancing;
            batch.add(fmt::format("{} instancing {}", kind.name, static_cast<int>(instancing)),
                      optimize(upload, options, {}, {}).asset);
        }
    }
    EXPECT_TRUE(batch.has_no_errors());
}

// What is dropped leaves nodes that have to be sound without it.
TEST(SamplesValidate, with_instances_dropped) {
    const WrittenAsset source =
        write_asset(make_sample("forest", {.copies = 6000, .triangles = 200}), {}, {});
    const OptimizeOptions options = {
        .algorithm = "ias", .ratio = 0.01, .parameters = {{"prune_instances", true}}};
    const Optimized result =
        optimize({.asset = {.path = "forest.glb", .bytes = source.bytes}}, options, {}, {});
    EXPECT_FALSE(result.report.instancing.pruned.empty());
    ValidatorBatch batch;
    batch.add("forest", result.asset);
    EXPECT_TRUE(batch.has_no_errors());
}

TEST(SamplesValidate, with_everything_joined_into_one_mesh) {
    ValidatorBatch batch;
    for (const SampleKind& kind : sample_kinds()) {
        const Scene scene = make_sample(kind.name, {.joined = true});
        batch.add(kind.name, write_asset(scene, {}, {}));
    }
    EXPECT_TRUE(batch.has_no_errors());
}

}  // namespace
}  // namespace coppice::test
