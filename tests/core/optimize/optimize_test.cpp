#include "core/optimize/optimize.h"

#include <gmock/gmock.h>

#include <algorithm>
#include <string>
#include <utility>

#include "core/base/error.h"
#include "core/optimize/inspect.h"
#include "core/sample/sample.h"
#include "core/scene/instance.h"
#include "tests/support/shapes.h"

namespace coppice {
namespace {

using testing::ElementsAre;

struct Input {
    Bytes bytes;
    Upload upload() const { return {.asset = {.path = "in", .bytes = bytes}}; }
};

Input cad(Format format = Format::glb) {
    return {write_asset(make_sample("cad", {.copies = 21, .triangles = 300}), {.format = format}, {}).bytes};
}

TEST(Optimize, halves_the_triangles_and_keeps_the_instances_when_nothing_is_asked) {
    const Input input = cad();
    const Report report = optimize(input.upload(), {}, {}, {}).report;
    EXPECT_EQ(report.algorithm, "its");
    EXPECT_EQ(report.input.bytes, input.bytes.size());
    EXPECT_EQ(report.input.format, Format::glb);
    EXPECT_EQ(report.output.instances, 21U);
    EXPECT_EQ(report.output.meshes, 3U);
    EXPECT_NEAR(static_cast<double>(report.output.unique_triangles),
                0.5 * static_cast<double>(report.input.unique_triangles), 6);
    EXPECT_EQ(report.instancing.given, 21U);
    EXPECT_EQ(report.instancing.unique, 3U);
    ASSERT_EQ(report.meshes.size(), 3U);
    EXPECT_EQ(report.meshes[0].name, "plate");
    EXPECT_EQ(report.meshes[0].instances, 3U);
    EXPECT_LT(report.savings.bytes_vs_expanded, 1);
    EXPECT_GT(report.savings.bytes_saved_by_instancing, 0U);
}

TEST(Optimize, maps_every_given_instance_to_one_that_is_written) {
    const Report report = optimize(cad().upload(), {}, {}, {}).report;
    ASSERT_EQ(report.instancing.map.size(), 21U);
    for (const InstanceMapping& mapping : report.instancing.map) EXPECT_LT(mapping.mesh, 3U);
}

TEST(Optimize, writes_glb_unless_obj_came_in) {
    EXPECT_EQ(optimize(cad().upload(), {}, {}, {}).report.output.format, Format::glb);
    EXPECT_EQ(optimize(cad(Format::iobj).upload(), {}, {}, {}).report.output.format, Format::iobj);
    EXPECT_EQ(optimize(cad(Format::obj).upload(), {}, {}, {}).report.output.format, Format::iobj);
}

TEST(Optimize, stores_a_copy_per_instance_where_asked_to_expand) {
    const Report report = optimize(cad().upload(), {.instancing = Instancing::expand}, {}, {}).report;
    EXPECT_EQ(report.output.meshes, 21U);
    EXPECT_EQ(report.output.instances, 21U);
    EXPECT_EQ(report.output.unique_triangles, report.output.rendered_triangles);
    EXPECT_EQ(report.savings.bytes_saved_by_instancing, 0U);
    std::vector<uint32_t> meshes;
    for (const InstanceMapping& mapping : report.instancing.map) meshes.push_back(mapping.mesh);
    std::sort(meshes.begin(), meshes.end());
    EXPECT_EQ(std::unique(meshes.begin(), meshes.end()) - meshes.begin(), 21);
}

TEST(Optimize, refuses_an_instancing_that_the_chosen_format_cannot_express_before_it_works) {
    try {
        optimize(cad(Format::iobj).upload(), {.instancing = Instancing::expand}, {}, {});
        FAIL();
    } catch (const Error& error) {
        EXPECT_EQ(error.code(), ErrorCode::option_conflict);
        EXPECT_EQ(error.where(), "instancing");
    }
}

TEST(Optimize, keeps_the_error_of_the_world_under_the_limit_it_estimates) {
    const Report report = optimize(cad().upload(), {.error = 0.001}, {}, {}).report;
    for (const MeshReport& mesh : report.meshes) {
        EXPECT_LE(mesh.error_diagonal_fraction, 0.001);
        EXPECT_LT(mesh.triangles_out, mesh.triangles_in);
    }
}

TEST(Optimize, simplifies_meshes_that_stand_nowhere_too) {
    Scene scene = make_sample("cad", {.copies = 21, .triangles = 300});
    scene.roots.clear();
    const Input input = {write_asset(scene, {}, {}).bytes};
    const Report report = optimize(input.upload(), {}, {}, {}).report;
    EXPECT_EQ(report.output.instances, 0U);
    ASSERT_EQ(report.meshes.size(), 3U);
    for (const MeshReport& mesh : report.meshes) EXPECT_LT(mesh.triangles_out, mesh.triangles_in);
}

TEST(Optimize, tells_its_stages_and_a_progress_that_never_goes_back) {
    std::vector<std::string> stages;
    std::vector<double> progress;
    Watch watch;
    watch.stage = [&](std::string_view stage) {
        if (stages.empty() || stages.back() != stage) stages.emplace_back(stage);
    };
    watch.progress = [&](double fraction) { progress.push_back(fraction); };
    optimize(cad().upload(), {}, {}, watch);
    EXPECT_THAT(stages, ElementsAre("read", "discover", "simplify", "write"));
    EXPECT_TRUE(std::is_sorted(progress.begin(), progress.end()));
    EXPECT_EQ(progress.back(), 1);
}

// A stop at every point at which progress is told, without sleeping.
TEST(Optimize, can_be_stopped_anywhere) {
    const Input input = cad();
    size_t points = 0;
    optimize(input.upload(), {}, {}, {.progress = [&](double) { ++points; }});
    for (size_t point = 0; point < points; point += 1 + points / 25) {
        std::stop_source source;
        size_t seen = 0;
        const Watch watch = {.stop = source.get_token(), .progress = [&](double) {
                                 if (seen++ == point) source.request_stop();
                             }};
        const bool is_last = point + 1 >= points;
        if (is_last) break;  // told when everything is done
        EXPECT_THROW(optimize(input.upload(), {.threads = 1}, {}, watch), Error) << point << " of " << points;
    }
}

TEST(Optimize, measures_its_stages) {
    const StageTimes times = optimize(cad().upload(), {}, {}, {}).report.timing_ms;
    EXPECT_GT(times.read, 0);
    EXPECT_GT(times.simplify, 0);
    EXPECT_GT(times.write, 0);
    EXPECT_GE(times.total, times.read + times.simplify + times.write);
}

// Its nodes' matrices are finite, what they multiply to is not.
Input too_far_out() {
    Scene scene = make_sample("cad", {.copies = 1, .triangles = 300});
    const Transform huge = from_trs({}, {0, 0, 0, 1}, {1e200, 1e200, 1e200});
    Node above;
    above.local = huge;
    above.children = std::exchange(scene.roots, {static_cast<uint32_t>(scene.nodes.size())});
    for (const uint32_t child : above.children) {
        scene.nodes[child].parent = scene.roots[0];
        scene.nodes[child].local = huge;
    }
    scene.nodes.push_back(above);
    return {write_asset(scene, {}, {}).bytes};
}

// Of 1600 tetrahedra every second one is a node, the others are a batch.
Scene field() {
    Scene scene;
    scene.meshes.push_back(shapes::tetrahedron());
    scene.materials.resize(1);
    Node batch;
    batch.mesh = 0;
    for (uint32_t i = 0; i < 1600; ++i) {
        const Transform place = from_trs({2.0 * i, 0, 0}, {0, 0, 0, 1}, {1, 1, 1});
        if (i % 2 == 0) {
            batch.batch.push_back(place);
            continue;
        }
        scene.roots.push_back(static_cast<uint32_t>(scene.nodes.size()));
        scene.nodes.push_back({.name = "single", .local = place, .mesh = 0});
    }
    scene.roots.push_back(static_cast<uint32_t>(scene.nodes.size()));
    scene.nodes.push_back(batch);
    return scene;
}

Input written(const Scene& scene, Format format = Format::glb) {
    return {write_asset(scene, {.format = format}, {}).bytes};
}

OptimizeOptions pruning(double ratio) {
    return {.algorithm = "ias", .ratio = ratio, .parameters = {{"prune_instances", true}}};
}

Scene read_again(const WrittenAsset& asset) {
    return read_asset({.asset = {.path = "out", .bytes = asset.bytes}}, {}, {}).scene;
}

TEST(PruneInstances, takes_out_of_the_scene_what_the_report_says) {
    const Optimized result = optimize(written(field()).upload(), pruning(0.25), {}, {});
    const Report& report = result.report;
    EXPECT_EQ(report.input.instances, 1600U);
    EXPECT_EQ(report.output.instances, 400U);
    EXPECT_EQ(report.output.rendered_triangles, 1600U);
    EXPECT_EQ(report.meshes[0].instances, 400U);
    EXPECT_EQ(report.instancing.given, 1600U);
    EXPECT_EQ(report.instancing.pruned.size(), 1200U);
    ASSERT_EQ(report.warnings.size(), 1U);
    EXPECT_EQ(report.warnings[0].code, "instances.pruned");
    EXPECT_EQ(report.warnings[0].count, 1200U);
    EXPECT_EQ(instance_count(read_again(result.asset)), 400U);
}

// The others stay where they were, in their order.
TEST(PruneInstances, maps_those_that_stay_to_where_they_stood) {
    const Scene before = field();
    const Optimized result = optimize(written(before).upload(), pruning(0.25), {}, {});
    const std::vector<Instance> left = instances(read_again(result.asset));
    const InstancingReport& told = result.report.instancing;
    ASSERT_EQ(told.map.size(), left.size());
    size_t mapped = 0, pruned = 0;
    for (const Instance& instance : instances(before)) {
        if (pruned < told.pruned.size() &&
            told.pruned[pruned] == PrunedInstance{instance.node, instance.in_batch}) {
            ++pruned;
            continue;
        }
        ASSERT_LT(mapped, left.size());
        EXPECT_EQ(told.map[mapped].node, instance.node);
        EXPECT_EQ(told.map[mapped].instance, left[mapped].in_batch);
        EXPECT_EQ(left[mapped].world, instance.world);
        ++mapped;
    }
    EXPECT_EQ(mapped, 400U);
    EXPECT_EQ(pruned, 1200U);
}

TEST(PruneInstances, writes_the_same_bytes_for_any_number_of_threads) {
    const Input input = written(field());
    OptimizeOptions options = pruning(0.3);
    options.threads = 1;
    const Bytes one = optimize(input.upload(), options, {}, {}).asset.bytes;
    options.threads = 4;
    EXPECT_EQ(optimize(input.upload(), options, {}, {}).asset.bytes, one);
    options.parameters["seed"] = 2.0;
    EXPECT_NE(optimize(input.upload(), options, {}, {}).asset.bytes, one);
}

TEST(PruneInstances, reaches_instanced_and_plain_obj_too) {
    OptimizeOptions options = pruning(0.25);
    for (const Format format : {Format::iobj, Format::obj}) {
        options.format = format;
        const Optimized result = optimize(written(field()).upload(), options, {}, {});
        EXPECT_EQ(result.report.output.rendered_triangles, 1600U) << id(format);
        EXPECT_EQ(result.report.instancing.map.size(), 400U) << id(format);
    }
}

TEST(PruneInstances, leaves_everything_where_it_is_not_asked) {
    const Report report =
        optimize(written(field()).upload(), {.algorithm = "ias", .ratio = 0.25}, {}, {}).report;
    EXPECT_EQ(report.output.instances, 1600U);
    EXPECT_TRUE(report.instancing.pruned.empty());
}

TEST(Inspect, refuses_what_stands_nowhere_as_optimize_does) {
    const Input input = too_far_out();
    const auto is_malformed =
        testing::Throws<Error>(testing::Property(&Error::code, ErrorCode::asset_malformed));
    EXPECT_THAT([&] { inspect(input.upload(), {}, {}); }, is_malformed);
    EXPECT_THAT([&] { optimize(input.upload(), {}, {}, {}); }, is_malformed);
}

TEST(Inspect, says_what_is_in_an_asset) {
    const Input input = cad();
    const Inspection inspection = inspect(input.upload(), {}, {});
    EXPECT_EQ(inspection.summary.instances, 21U);
    EXPECT_EQ(inspection.materials, 2U);
    EXPECT_EQ(inspection.images, 2U);
    ASSERT_EQ(inspection.meshes.size(), 3U);
    EXPECT_EQ(inspection.meshes[1].name, "bolt");
    EXPECT_EQ(inspection.meshes[1].instances, 12U);
    EXPECT_THAT(inspection.meshes[1].attributes, ElementsAre("POSITION", "NORMAL", "TEXCOORD_0"));
    EXPECT_EQ(inspection.meshes[1].border_edges, 0U);
    EXPECT_GT(inspection.bytes_saved_by_instancing, 0U);
    EXPECT_FALSE(inspection.bounds.empty());
}

}  // namespace
}  // namespace coppice
