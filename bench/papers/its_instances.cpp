// The ITS paper's claim, that N instances cost what one mesh costs: against N, and on real scenes, which it
// lacks.
#include <fmt/core.h>

#include <string>

#include "bench/papers/measure.h"
#include "bench/papers/scene_runs.h"
#include "bench/papers/tables.h"
#include "tests/support/test_assets.h"

namespace coppice::papers {
namespace {

void print_against_instances(const Model& model) {
    fmt::print(
        "\n### ITS, time against instances\n\nOne mesh ({}, {} triangles), 50 % removed, ms of the simplify "
        "stage, "
        "medians of {}; `gaps` and `quadric` expanded. The goal is at least 0.8 an instance.\n\n"
        "| instances | quadric | gaps | ias | its | gaps / its | an instance | quadric / ias | an instance | "
        "its / ias "
        "|\n|---:|---:|---:|---:|---:|---:|---:|---:|---:|---:|\n",
        model.name, model.mesh.triangle_count(), runs);
    for (const uint32_t n : {1U, 2U, 4U, 8U, 13U, 16U}) {
        const Bytes scene = scene_of(model, n);
        const SceneRuns r = run_scene({.asset = {.path = "scene.glb", .bytes = scene}}, 0.5);
        const double to_its = r[gaps].simplify_ms / r[its].simplify_ms;
        const double to_ias = r[quadric].simplify_ms / r[ias].simplify_ms;
        fmt::print(
            "| {} | {:.1f} | {:.1f} | {:.1f} | {:.1f} | {:.2f} | {:.2f} | {:.2f} | {:.2f} | {:.2f} |\n", n,
            r[quadric].simplify_ms, r[gaps].simplify_ms, r[ias].simplify_ms, r[its].simplify_ms, to_its,
            to_its / n, to_ias, to_ias / n, r[its].simplify_ms / r[ias].simplify_ms);
    }
}

// Of those that the algorithm had before it: with instances=expand a copy for each instance.
uint64_t triangles_removed(const Report& report) {
    const bool is_expanded = report.output.meshes == report.output.instances;
    return (is_expanded ? report.input.rendered_triangles : report.input.unique_triangles) -
           report.output.unique_triangles;
}

void print_real_scene(const std::string& file) {
    if (!is_asset(file)) {
        fmt::print("| {} | | no such file in the assets | | | | | | | | |\n", file);
        return;
    }
    const test::UploadedAsset asset = test::load_asset(file);
    for (const double removed : {0.1, 0.2, 0.5}) {
        const SceneRuns r = run_scene(asset.upload(), removed);
        for (size_t c = 0; c < count_contenders; ++c) {
            const AssetSummary& left = r[c].report.output;
            fmt::print(
                "| {} | {:.0f} % | {} | {} of {} | {} | {} | {} | {:.0f} | {:.1f} | {:.2f} | {:.1f} |\n",
                file, 100 * removed, contender_names[c], left.instances, left.meshes, left.unique_vertices,
                left.unique_triangles, left.rendered_triangles, static_cast<double>(left.bytes) / 1000,
                r[c].simplify_ms, r[c].simplify_ms / r[its].simplify_ms,
                1000 * r[c].simplify_ms / static_cast<double>(triangles_removed(r[c].report)));
        }
    }
}

}  // namespace

void print_its_instances() {
    print_against_instances(drawn_model(5002));
    fmt::print(
        "\n### ITS, real scenes\n\nAs they are published; columns as in Table 3, and the time for each "
        "triangle removed.\n\n"
        "| scene | removed | algorithm | instances of meshes | vertices | triangles | drawn | KB | ms | ms / "
        "its | us a "
        "triangle |\n|---|---:|---|---:|---:|---:|---:|---:|---:|---:|---:|\n");
    for (const char* file : {"instanced/2CylinderEngine.glb", "instanced/WhackAMole.glb"})
        print_real_scene(file);
}

}  // namespace coppice::papers
