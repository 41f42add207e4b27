#include "core/optimize/inspect.h"

#include <fmt/format.h>
#include <fmt/ostream.h>
#include <fmt/ranges.h>

#include <CLI/CLI.hpp>
#include <memory>

#include "cli/commands.h"
#include "cli/files.h"
#include "cli/progress_bar.h"
#include "cli/summary.h"
#include "proto/report.h"

namespace coppice {

namespace {

void print_for_people(const Inspection& inspection, std::ostream& out) {
    const AssetSummary& s = inspection.summary;
    fmt::print(out, "{}, {}: {}, {}, {}, {} ({})\n", id(s.format), print_bytes(s.bytes), print_meshes(s),
               print_count(inspection.nodes, "node", "nodes"),
               print_count(inspection.materials, "material", "materials"),
               print_count(inspection.images, "image", "images"), print_bytes(s.texture_bytes));
    fmt::print(out, "triangles: {}; vertices {}, wedges {}\n", print_triangles(s),
               print_count(s.unique_vertices), print_count(s.wedges));
    const Bounds& box = inspection.bounds;
    if (!box.empty()) {
        fmt::print(out, "box: ({:g}, {:g}, {:g}) to ({:g}, {:g}, {:g}), diagonal {:g}\n", box.min.x,
                   box.min.y, box.min.z, box.max.x, box.max.y, box.max.z, box.diagonal());
    }
    fmt::print(out, "instancing saves {} of geometry\n\n", print_bytes(inspection.bytes_saved_by_instancing));
    fmt::print(out, "{:>9} {:>10} {:>9} {:>7} {:>12}  mesh\n", "instances", "triangles", "vertices",
               "borders", "non-manifold");
    for (const InspectedMesh& mesh : inspection.meshes) {
        fmt::print(out, "{:>9} {:>10} {:>9} {:>7} {:>12}  {} [{}]\n", print_count(mesh.instances),
                   print_count(mesh.triangles), print_count(mesh.vertices), print_count(mesh.border_edges),
                   print_count(mesh.non_manifold_edges), mesh.name, fmt::join(mesh.attributes, " "));
    }
}

struct InspectFlags {
    std::string input;
    bool json = false;
};

int inspect_file(const InspectFlags& flags, const Terminal& terminal) {
    AssetFile input(flags.input);
    const Inspection inspection = [&] {
        ProgressBar bar(terminal);
        return inspect(input.upload(), generous_limits(), bar.watch());
    }();
    if (flags.json) {
        terminal.out << print_inspection(inspection) << "\n";
        return 0;
    }
    print_for_people(inspection, terminal.out);
    print_warnings(inspection.warnings, terminal.err);
    return 0;
}

}  // namespace

Action add_inspect(CLI::App& app, const Terminal& terminal) {
    auto flags = std::make_shared<InspectFlags>();
    CLI::App* command =
        app.add_subcommand("inspect", "Tells what is in an asset, and what instancing saves in it");
    command->add_option("IN", flags->input, "The asset's file")->required();
    command->add_flag("--json", flags->json, "As JSON");
    command->footer(
        "Examples:\n"
        "  coppice inspect forest.glb\n"
        "  coppice inspect forest.glb --json");
    return [flags, &terminal] { return inspect_file(*flags, terminal); };
}

}  // namespace coppice
