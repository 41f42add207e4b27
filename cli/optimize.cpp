#include "core/optimize/optimize.h"

#include <fmt/format.h>
#include <fmt/ostream.h>

#include <CLI/CLI.hpp>
#include <map>
#include <memory>

#include "cli/check_count.h"
#include "cli/commands.h"
#include "cli/files.h"
#include "cli/output.h"
#include "cli/progress_bar.h"
#include "cli/summary.h"
#include "cli/write_files.h"
#include "core/simplify/registry.h"
#include "proto/options.h"
#include "proto/report.h"

namespace coppice {

namespace {

struct OptimizeFlags {
    std::string input, output, report;
    unsigned threads = 0;
    std::map<std::string, std::string> options;  // by name; those of the wire contract
};

std::string describe(const Algorithm& algorithm, const Parameter& parameter) {
    std::string text = fmt::format("[{}] {}", algorithm.id, parameter.title);
    if (!parameter.unit.empty()) text += fmt::format(", in {}", parameter.unit);
    for (const std::string_view choice : parameter.choices) {
        text += fmt::format("{} {}", choice == parameter.choices.front() ? ":" : ",", choice);
    }
    return text;
}

// Options and parameters come from where they are defined, so that the command line knows each of them.
void add_options(CLI::App& command, OptimizeFlags& flags) {
    const auto add = [&](const std::string& name, const std::string& text, const std::string& group) {
        command
            .add_option_function<std::string>(
                "--" + name, [&flags, name](const std::string& value) { flags.options[name] = value; }, text)
            ->group(group)
            ->type_name("");
    };
    for (const OptionDescription& option : describe_options()) {
        add(std::string(option.name), std::string(option.takes), "Options");
    }
    for (const Algorithm& algorithm : algorithms()) {
        for (const Parameter& parameter : algorithm.parameters) {
            const std::string name = "parameters." + std::string(parameter.id);
            if (command.get_option_no_throw("--" + name) != nullptr)
                continue;  // two algorithms may share a name
            add(name, describe(algorithm, parameter), "Parameters of the algorithms");
        }
    }
}

OptimizeOptions options_of(const OptimizeFlags& flags) {
    OptimizeOptions options = parse_options({flags.options.begin(), flags.options.end()});
    options.format = output_format(flags.output, options.format);
    options.base_name = std::filesystem::path(flags.output).stem().string();
    options.threads = flags.threads;
    return options;
}

std::string percent(uint64_t part, uint64_t whole) {
    return whole == 0
               ? ""
               : fmt::format(" ({:.0f} %)", 100.0 * static_cast<double>(part) / static_cast<double>(whole));
}

void summarize(const Report& report, const OptimizeFlags& flags, std::ostream& err) {
    const AssetSummary &in = report.input, &out = report.output;
    fmt::print(err, "{} {} -> {} {}{}\n", flags.input, print_bytes(in.bytes), flags.output,
               print_bytes(out.bytes), percent(out.bytes, in.bytes));
    fmt::print(err, "{}\n", print_meshes(out));
    fmt::print(err, "stored triangles {} -> {}{}, drawn {} -> {}\n", print_count(in.unique_triangles),
               print_count(out.unique_triangles), percent(out.unique_triangles, in.unique_triangles),
               print_count(in.rendered_triangles), print_count(out.rendered_triangles));
    const StageTimes& t = report.timing_ms;
    fmt::print(err, "{}: read {:.0f} ms, simplify {:.0f} ms, write {:.0f} ms, total {:.0f} ms\n",
               report.algorithm, t.read, t.simplify, t.write, t.total);
    print_warnings(report.warnings, err);
}

void write_report(const Report& report, const std::string& path, const Terminal& terminal) {
    const std::string json = print_report(report) + "\n";
    if (path == "-") {
        terminal.out << json << std::flush;
    } else {
        write_file(path, as_bytes(json));
    }
}

int optimize_file(const OptimizeFlags& flags, const Terminal& terminal) {
    const OptimizeOptions options = options_of(flags);
    AssetFile input(flags.input);
    const Optimized result = [&] {
        ProgressBar bar(terminal);
        return optimize(input.upload(), options, generous_limits(), bar.watch());
    }();
    write_asset_file(result.asset, flags.output);
    if (!flags.report.empty()) write_report(result.report, flags.report, terminal);
    summarize(result.report, flags, terminal.err);
    return 0;
}

}  // namespace

Action add_optimize(CLI::App& app, const Terminal& terminal) {
    auto flags = std::make_shared<OptimizeFlags>();
    CLI::App* command =
        app.add_subcommand("optimize", "Simplifies each unique mesh of an asset once and writes it small");
    command
        ->add_option("IN", flags->input,
                     "A .glb, .gltf, .obj, .iobj, .ply, .stl, or a .zip of one with its resources")
        ->required();
    command
        ->add_option("-o,--output", flags->output,
                     "Where to; its ending is the format: .glb, .gltf, .obj, .iobj, or .zip of a gltf (or "
                     "of an obj or iobj, with --format). Another name takes --format")
        ->required();
    command
        ->add_option("--threads", flags->threads,
                     "How many threads; 0: one per core. Never changes the result")
        ->check(check_count);
    command->add_option("--report", flags->report,
                        "Writes the report as JSON to this file, or to standard output (-)");
    add_options(*command, *flags);
    command->footer(
        "Examples:\n"
        "  coppice optimize forest.glb -o small.glb                         half of each mesh's triangles\n"
        "  coppice optimize forest.glb -o small.glb --ratio 0.9 --report -  the papers' \"10 % simplified\"\n"
        "  coppice optimize city.obj -o city.glb --triangles 20000 --error 0.001");
    return [flags, &terminal] { return optimize_file(*flags, terminal); };
}

}  // namespace coppice
