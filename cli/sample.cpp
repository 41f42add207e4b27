#include "core/sample/sample.h"

#include <fmt/format.h>
#include <fmt/ostream.h>

#include <CLI/CLI.hpp>
#include <memory>

#include "cli/check_count.h"
#include "cli/commands.h"
#include "cli/output.h"
#include "cli/summary.h"
#include "core/optimize/report.h"

namespace coppice {

namespace {

struct SampleFlags {
    std::string name, output;
    SampleOptions options;
};

int write_sample(const SampleFlags& flags, const Terminal& terminal) {
    const std::filesystem::path path = flags.output;
    const Format format = output_format(path);
    const Scene scene = make_sample(flags.name, flags.options);
    const WrittenAsset asset = write_asset(scene, {.format = format, .base_name = path.stem().string()}, {});
    write_asset_file(asset, path);
    const AssetSummary summary = summarize(scene, format, asset.bytes.size());
    fmt::print(terminal.err, "{} {}: {}; triangles: {}\n", flags.output, print_bytes(summary.bytes),
               print_meshes(summary), print_triangles(summary));
    print_warnings(asset.warnings, terminal.err);
    return 0;
}

std::string list_samples() {
    std::string text = "Samples:\n";
    for (const SampleKind& kind : sample_kinds()) {
        const uint32_t about = (kind.triangles + 50) / 100 * 100;  // the shape decides how many exactly
        text += fmt::format("  {:<9} {}; {} copies, about {} triangles each\n", kind.name, kind.title,
                            kind.copies, about);
    }
    return text + "Example:\n  coppice sample forest -o forest.glb --seed 7 --scale 2";
}

}  // namespace

Action add_sample(CLI::App& app, const Terminal& terminal) {
    auto flags = std::make_shared<SampleFlags>();
    CLI::App* command = app.add_subcommand("sample", "Makes a scene to try coppice on");
    command->add_option("NAME", flags->name, "One of those below")->required();
    command
        ->add_option("-o,--output", flags->output, "Where to: .glb, .gltf, .obj, .iobj, or .zip (of a .gltf)")
        ->required();
    command
        ->add_option("--seed", flags->options.seed, "Another seed: other shapes and places, the same counts")
        ->check(check_count);
    command->add_option("--scale", flags->options.scale,
                        "Multiplies the copies and the triangles of each mesh");
    command->add_option("--copies", flags->options.copies, "How many instances of the repeated meshes")
        ->check(check_count);
    command->add_option("--triangles", flags->options.triangles, "Of each repeated mesh, about")
        ->check(check_count);
    command->add_flag("--joined", flags->options.joined, "Everything in one mesh, nothing instanced");
    command->footer(list_samples());
    return [flags, &terminal] { return write_sample(*flags, terminal); };
}

}  // namespace coppice
