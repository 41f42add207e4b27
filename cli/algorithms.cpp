#include <fmt/format.h>
#include <fmt/ostream.h>

#include <CLI/CLI.hpp>
#include <memory>

#include "cli/commands.h"
#include "core/simplify/registry.h"
#include "proto/report.h"

namespace coppice {

namespace {

std::string print_value(const ParameterValue& value) {
    if (const auto* text = std::get_if<std::string>(&value)) return *text;
    if (const auto* flag = std::get_if<bool>(&value)) return *flag ? "true" : "false";
    return fmt::format("{}", std::get<double>(value));
}

void print_parameter(const Parameter& parameter, std::ostream& out) {
    fmt::print(out, "    {}: {}", parameter.id, parameter.title);
    if (!parameter.unit.empty()) fmt::print(out, ", in {}", parameter.unit);
    for (const std::string_view choice : parameter.choices) {
        fmt::print(out, "{} {}", choice == parameter.choices.front() ? ":" : ",", choice);
    }
    if (parameter.default_value) fmt::print(out, " (default {})", print_value(*parameter.default_value));
    fmt::print(out, "\n");
}

void print_for_people(std::ostream& out) {
    for (const Algorithm& algorithm : algorithms()) {
        const bool is_default = algorithm.id == default_algorithm().id;
        fmt::print(out, "{}{}: {}\n    {}\n", algorithm.id, is_default ? " (default)" : "", algorithm.title,
                   algorithm.citation);
        for (const Parameter& parameter : algorithm.parameters) print_parameter(parameter, out);
    }
}

}  // namespace

Action add_algorithms(CLI::App& app, const Terminal& terminal) {
    auto json = std::make_shared<bool>(false);
    CLI::App* command = app.add_subcommand("algorithms", "Lists the algorithms and their parameters");
    command->add_flag("--json", *json, "As JSON");
    command->footer(
        "Example:\n"
        "  coppice algorithms");
    return [json, &terminal] {
        if (*json) {
            terminal.out << print_algorithms() << "\n";
        } else {
            print_for_people(terminal.out);
        }
        return 0;
    };
}

}  // namespace coppice
