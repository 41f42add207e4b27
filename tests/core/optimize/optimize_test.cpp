#include "core/optimize/optimize.h"

#include <gmock/gmock.h>

#include <algorithm>
#include <string>
#include <utility>

#include "core/base/error.h"
#include "core/optimize/inspect.h"
#include "core/sample/sample.h"

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
