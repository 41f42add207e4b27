#include "core/optimize/report.h"

#include <gtest/gtest.h>

#include "core/optimize/check.h"
#include "core/optimize/engine.h"
#include "core/optimize/summary.h"
#include "core/sample/sample.h"

namespace coppice {
namespace {

TEST(Summarize, counts_what_is_stored_and_what_is_drawn) {
    const Scene scene = make_sample("bunny13", {});
    const AssetSummary summary = summarize(scene, Format::glb, 1000);
    EXPECT_EQ(summary.bytes, 1000U);
    EXPECT_EQ(summary.meshes, 1U);
    EXPECT_EQ(summary.instances, 13U);
    EXPECT_EQ(summary.unique_triangles, 4968U);
    EXPECT_EQ(summary.rendered_triangles, 13U * 4968);
    EXPECT_EQ(summary.unique_vertices, 2503U);
    EXPECT_EQ(summary.wedges, scene.meshes[0].wedge_count());
    EXPECT_EQ(summary.normals, summary.wedges);
    EXPECT_EQ(summary.texture_coordinates, summary.wedges);
    EXPECT_EQ(summary.texture_bytes, scene.images[0].bytes.size());
}

TEST(Summarize, counts_a_copy_per_instance_where_the_file_stores_one) {
    const Scene scene = make_sample("bunny13", {});
    const AssetSummary summary = summarize(scene, Format::obj, 0);
    EXPECT_EQ(summary.meshes, 13U);
    EXPECT_EQ(summary.unique_triangles, summary.rendered_triangles);
}

TEST(Summarize, leaves_out_wedges_whose_material_has_no_texture_coordinates) {
    Scene scene = make_sample("bunny13", {});
    scene.meshes[0].slots[0].has_attribute = {true, false};
    const AssetSummary summary = summarize(scene, Format::glb, 0);
    EXPECT_EQ(summary.texture_coordinates, 0U);
    EXPECT_EQ(summary.normals, summary.wedges);
}

TEST(Savings, compares_with_one_stored_copy_per_instance) {
    const std::vector<uint64_t> mesh_bytes = {100, 50}, instances = {10, 1};
    const Savings savings = coppice::savings(2000, 1000, mesh_bytes, instances);
    EXPECT_EQ(savings.bytes_saved_by_instancing, 900U);
    EXPECT_DOUBLE_EQ(savings.bytes_ratio, 0.5);
    EXPECT_DOUBLE_EQ(savings.bytes_vs_expanded, 1000.0 / 1900);
}

TEST(Savings, does_not_count_meshes_that_stand_nowhere) {
    EXPECT_EQ(savings(1, 1, std::vector<uint64_t>{100}, std::vector<uint64_t>{0}).bytes_saved_by_instancing,
              0U);
}

struct Outcome {
    Scene scene = make_sample("bunny13", {});
    Placement placement = place(scene);
    Target target = {.triangles = 100};
    Simplified simplified = {.mesh = scene.meshes[0]};

    std::vector<std::string> warnings(const OptimizeOptions& options = {}) const {
        std::vector<std::string> codes;
        for (const Warning& warning : check_result(scene, placement, {target}, {simplified}, options)) {
            codes.push_back(warning.code);
        }
        return codes;
    }
};

TEST(CheckResult, warns_where_topology_stopped_it_before_the_target) {
    Outcome outcome;
    outcome.simplified.stop_reason = StopReason::topology;
    EXPECT_EQ(outcome.warnings(), std::vector<std::string>{"target.not_reached"});
    outcome.simplified.stop_reason = StopReason::already_smaller;
    EXPECT_TRUE(outcome.warnings().empty());
}

// users.md 5: instances vanished or moved.
TEST(CheckResult, warns_where_a_mesh_vanished_or_its_box_moved) {
    Outcome outcome;
    for (Vec3f& position : outcome.simplified.mesh.positions) position.x += 10;
    EXPECT_EQ(outcome.warnings(), std::vector<std::string>{"bounds.changed"});
    outcome.simplified.mesh = {};
    EXPECT_EQ(outcome.warnings(), std::vector<std::string>{"mesh.vanished"});
}

TEST(CheckResult, warns_that_an_error_limit_holds_in_the_rest_pose_only) {
    Outcome outcome;
    EXPECT_TRUE(outcome.warnings({.error = 0.01}).empty());
    outcome.scene.nodes[0].skinned = true;
    EXPECT_EQ(outcome.warnings({.error = 0.01}), std::vector<std::string>{"error.rest_pose_only"});
    EXPECT_TRUE(outcome.warnings({}).empty());
    outcome.scene.nodes[0].skinned = false;
    outcome.scene.nodes[0].animated = true;
    EXPECT_EQ(outcome.warnings({.error = 0.01}), std::vector<std::string>{"error.rest_pose_only"});
}

TEST(Engine, says_which_it_is) {
    EXPECT_EQ(engine_version(), COPPICE_VERSION);
    EXPECT_NE(engine_build().find(' '), std::string_view::npos);
}

}  // namespace
}  // namespace coppice
