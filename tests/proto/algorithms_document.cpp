#include "tests/proto/algorithms_document.h"

#include <fmt/format.h>

#include "core/simplify/registry.h"

namespace coppice {
namespace {

std::string default_of(const Parameter& parameter) {
    if (!parameter.default_value) return "";
    const auto print = [](const auto& value) { return fmt::format("`{}`", value); };
    return std::visit(print, *parameter.default_value);
}

std::string values_of(const Parameter& parameter) {
    if (!parameter.choices.empty()) return fmt::format("`{}`", fmt::join(parameter.choices, "`, `"));
    if (!parameter.form.empty()) return std::string(parameter.form);
    if (parameter.kind == Parameter::Kind::boolean) return "`true`, `false`";
    std::string text = parameter.kind == Parameter::Kind::integer ? "whole number" : "number";
    if (parameter.minimum)
        text +=
            fmt::format(", {} {}", parameter.minimum_excluded ? "more than" : "at least", *parameter.minimum);
    if (parameter.maximum) text += fmt::format(", at most {}", *parameter.maximum);
    return text;
}

std::string unit_of(const Parameter& parameter) {
    if (parameter.kind != Parameter::Kind::length) return std::string(parameter.unit);
    return fmt::format("{}, or mesh units with the suffix `u`", parameter.unit);
}

std::string row(const Parameter& parameter) {
    return fmt::format("| `{}` | {} | {} | {} | {} |\n", parameter.id, parameter.title, values_of(parameter),
                       unit_of(parameter), default_of(parameter));
}

std::string section(const Algorithm& algorithm) {
    std::string text =
        fmt::format("\n## {}\n\n{}{}. {}.\n", algorithm.id, algorithm.title,
                    algorithm.id == default_algorithm().id ? " (the default)" : "", algorithm.citation);
    if (algorithm.instance_aware)
        text += "\nThe cost of a collapse counts in the proportions that the instances give the mesh.\n";
    if (algorithm.parameters.empty()) return text + "\nIt has no parameters.\n";
    text += "\n| parameter | meaning | values | unit | default |\n|---|---|---|---|---|\n";
    for (const Parameter& parameter : algorithm.parameters) text += row(parameter);
    return text;
}

}  // namespace

std::string algorithms_document() {
    std::string text =
        "# Algorithms\n\n"
        "Choose one by `algorithm=ID`; its parameters are `parameters.NAME=VALUE` over HTTP, "
        "`--parameters.NAME VALUE`\n"
        "on the command line. The same list is at `/v1/algorithms` and from `coppice algorithms`. How fast "
        "and how exact each\n"
        "is stands in [results](results.md).\n\n"
        "This page is written from the code, by the test `AlgorithmsDocument.is_what_the_registry_has`.\n";
    for (const Algorithm& algorithm : algorithms()) text += section(algorithm);
    return text;
}

}  // namespace coppice
