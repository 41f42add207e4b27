#include "core/optimize/compare.h"

#include <fmt/format.h>
#include <fmt/ostream.h>

#include <CLI/CLI.hpp>
#include <map>
#include <memory>

#include "cli/commands.h"
#include "cli/files.h"
#include "cli/progress_bar.h"
#include "cli/summary.h"
#include "proto/compare_options.h"
#include "proto/comparison.h"

namespace coppice {

namespace {

struct CompareFlags {
    std::string reference, candidate;
    bool json = false;
    unsigned threads = 0;
    std::map<std::string, std::string> options;  // by name; those of the wire contract
};

void print_row(std::string_view what, double largest, double mean, double third, std::ostream& out) {
    fmt::print(out, "{:<34} {:>12.6g} {:>12.6g} {:>12.6g}\n", what, largest, mean, third);
}

void print_row(std::string_view what, const Spread& spread, double scale, std::ostream& out) {
    print_row(what, spread.largest * scale, spread.mean * scale, spread.root_mean_square * scale, out);
}

void print_angles(std::string_view what, const std::optional<AngleSpread>& angles, std::ostream& out) {
    if (angles) print_row(what, angles->largest, angles->mean, angles->percentile_95, out);
}

void print_surface(const SurfaceComparison& surface, double diagonal, std::ostream& out) {
    fmt::print(out, "{:<34} {:>12} {:>12} {:>12}\n", "", "largest", "mean", "rms");
    print_row("distance, model units", surface.symmetric, 1, out);
    print_row("  reference to candidate", surface.reference_to_candidate, 1, out);
    print_row("  candidate to reference", surface.candidate_to_reference, 1, out);
    if (diagonal > 0) print_row("distance, diagonals", surface.symmetric, 1 / diagonal, out);
    if (surface.texture) print_row("texture coordinates", *surface.texture, 1, out);
    if (surface.texture_model_units)
        print_row("  as lengths on the reference", *surface.texture_model_units, 1, out);
    if (surface.colors) print_row("vertex colours, 0..1", *surface.colors, 1, out);
    fmt::print(out, "{:<34} {:>12} {:>12} {:>12}\n", "", "largest", "mean", "95 %");
    print_angles("vertex normals, degrees", surface.normals, out);
    print_angles("triangles' normals, degrees", surface.facets, out);
    fmt::print(out, "flipped triangles: {}; with their texture mirrored: {}\n",
               print_count(surface.flips.triangles), print_count(surface.flips.texture_triangles));
}

void print_counts(std::string_view what, uint64_t reference, uint64_t candidate, std::ostream& out) {
    fmt::print(out, "{:<34} {:>12} {:>12}\n", what, print_count(reference), print_count(candidate));
}

void print_numbers(std::string_view what, double reference, double candidate, std::ostream& out) {
    fmt::print(out, "{:<34} {:>12.6g} {:>12.6g}\n", what, reference, candidate);
}

void print_elements(const SceneElements& reference, const SceneElements& candidate, std::ostream& out) {
    const Elements &a = reference.elements, &b = candidate.elements;
    fmt::print(out, "\n{:<34} {:>12} {:>12}\n", "unique meshes, each once", "reference", "candidate");
    print_counts("triangles", a.triangles, b.triangles, out);
    print_counts("vertices", a.vertices, b.vertices, out);
    print_counts("degenerate triangles", a.degenerate_triangles, b.degenerate_triangles, out);
    print_counts("duplicate triangles", a.duplicate_triangles, b.duplicate_triangles, out);
    print_counts("non-manifold edges", a.non_manifold_edges, b.non_manifold_edges, out);
    print_counts("edges of opposed triangles", a.inconsistent_edges, b.inconsistent_edges, out);
    print_counts("border edges", a.border_edges, b.border_edges, out);
    print_counts("components", a.components, b.components, out);
    if (reference.self_intersections && candidate.self_intersections) {
        print_counts("self-intersecting pairs", reference.self_intersections->pairs,
                     candidate.self_intersections->pairs, out);
    }
    print_numbers("Euler number", static_cast<double>(a.euler_number), static_cast<double>(b.euler_number),
                  out);
    print_numbers("border length", a.border_length, b.border_length, out);
    print_numbers("area", a.area, b.area, out);
    print_numbers("volume", a.volume, b.volume, out);
    print_numbers("smallest angle, degrees", a.smallest_angle, b.smallest_angle, out);
}

void print_meshes_of(const SceneComparison& scenes, std::ostream& out) {
    if (scenes.meshes.size() < 2) return;
    fmt::print(out, "\n{:>9} {:>12} {:>12} {:>12} {:>9}  {}\n", "instances", "largest", "mean", "rms",
               "flipped", "mesh, distances in its own units");
    for (const MeshComparison& mesh : scenes.meshes) {
        const Spread& distance = mesh.surface.symmetric;
        fmt::print(out, "{:>9} {:>12.6g} {:>12.6g} {:>12.6g} {:>9}  {}\n", print_count(mesh.instances),
                   distance.largest, distance.mean, distance.root_mean_square,
                   print_count(mesh.surface.flips.triangles), mesh.name);
    }
}

void print_for_people(const Comparison& comparison, std::ostream& out) {
    const auto describe = [&](std::string_view side, const AssetSummary& summary) {
        fmt::print(out, "{}: {}, {}, triangles: {}\n", side, id(summary.format), print_meshes(summary),
                   print_triangles(summary));
    };
    describe("reference", comparison.reference);
    describe("candidate", comparison.candidate);
    const SceneComparison& scenes = comparison.scenes;
    fmt::print(out, "diagonal of the reference: {:g}; {}\n\n", scenes.diagonal,
               scenes.is_by_mesh ? "each unique mesh was compared once, and counts with its instances"
                                 : "the meshes differ in number or place, so the scenes were expanded");
    print_surface(scenes.surface, scenes.diagonal, out);
    print_elements(scenes.reference, scenes.candidate, out);
    print_meshes_of(scenes, out);
}

int compare_files(const CompareFlags& flags, const Terminal& terminal) {
    CompareOptions options = parse_compare_options({flags.options.begin(), flags.options.end()});
    options.threads = flags.threads;
    AssetFile reference(flags.reference), candidate(flags.candidate);
    const Comparison comparison = [&] {
        ProgressBar bar(terminal);
        return compare(reference.upload(), candidate.upload(), options, generous_limits(), bar.watch());
    }();
    if (flags.json) {
        terminal.out << print_comparison(comparison) << "\n";
        return 0;
    }
    print_for_people(comparison, terminal.out);
    print_warnings(comparison.warnings, terminal.err);
    return 0;
}

}  // namespace

Action add_compare(CLI::App& app, const Terminal& terminal) {
    auto flags = std::make_shared<CompareFlags>();
    CLI::App* command = app.add_subcommand(
        "compare", "Tells how far one asset's surfaces are from another's, and what is wrong with them");
    command->add_option("REFERENCE", flags->reference, "The original")->required();
    command->add_option("CANDIDATE", flags->candidate, "What was made of it; the format may differ")
        ->required();
    command->add_flag("--json", flags->json, "As JSON");
    command->add_option("--threads", flags->threads,
                        "How many threads; 0: one per core. Never changes the result");
    for (const OptionDescription& option : describe_compare_options()) {
        const std::string name(option.name);
        const auto keep = [flags = flags.get(), name](const std::string& value) {
            flags->options[name] = value;
        };
        if (name == "self_intersections") {  // --self_intersections alone means true
            command->add_option_function<std::string>("--" + name, keep, "Looks for them too: true or false")
                ->type_name("")
                ->expected(0, 1)
                ->default_str("true");
        } else {
            command->add_option_function<std::string>("--" + name, keep, std::string(option.takes))
                ->type_name("");
        }
    }
    command->footer(
        "Distances are between points of one surface and the nearest points of the other (Metro): 10 "
        "samples\n"
        "for each triangle unless --samples says otherwise, with all vertices and along the edges.\n"
        "Example: coppice compare forest.glb small.glb --self_intersections");
    return [flags, &terminal] { return compare_files(*flags, terminal); };
}

}  // namespace coppice
