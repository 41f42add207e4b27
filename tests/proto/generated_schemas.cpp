#include "tests/proto/generated_schemas.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <cctype>
#include <nlohmann/json.hpp>
#include <vector>

#include "core/base/error.h"
#include "core/simplify/registry.h"

namespace coppice {
namespace {

// JSON is YAML too; quotes and escapes as they must be.
std::string quote(std::string_view text) {
    return nlohmann::json(text).dump();
}

std::string print(const ParameterValue& value) {
    if (const auto* number = std::get_if<double>(&value)) return fmt::format("{}", *number);
    return std::visit([](const auto& held) { return nlohmann::json(held).dump(); }, value);
}

// "attribute-quadric" -> "AttributeQuadricParameters"
std::string schema_name(const Algorithm& algorithm) {
    std::string name;
    bool starts_word = true;
    for (const char letter : algorithm.id) {
        if (letter == '-') {
            starts_word = true;
            continue;
        }
        name += starts_word ? static_cast<char>(std::toupper(static_cast<unsigned char>(letter))) : letter;
        starts_word = false;
    }
    return name + "Parameters";
}

std::string_view type_of(Parameter::Kind kind) {
    switch (kind) {
        case Parameter::Kind::boolean:
            return "boolean";
        case Parameter::Kind::number:
            return "number";
        case Parameter::Kind::integer:
            return "integer";
        case Parameter::Kind::choice:
        case Parameter::Kind::text:
            return "string";
        case Parameter::Kind::length:
            return "[number, string]";
    }
    return {};
}

std::string list(const std::vector<std::string>& items) {
    std::string text;
    for (const std::string& item : items) text += fmt::format("        - {}\n", item);
    return text;
}

std::string parameter_schema(const Parameter& parameter) {
    std::string text = fmt::format("        {}:\n", parameter.id);
    std::string description(parameter.title);
    if (!parameter.unit.empty()) description += fmt::format(" ({})", parameter.unit);
    text += fmt::format("          description: {}\n", quote(description));
    text += fmt::format("          type: {}\n", type_of(parameter.kind));
    if (!parameter.choices.empty())
        text += fmt::format("          enum: [{}]\n", fmt::join(parameter.choices, ", "));
    if (!parameter.pattern.empty())
        text += fmt::format("          pattern: {}\n", quote(fmt::format("^(?:{})$", parameter.pattern)));
    if (parameter.kind == Parameter::Kind::length)
        text += fmt::format("          pattern: {}\n", quote("^[0-9.eE+-]+u?$"));
    if (parameter.minimum) {
        text += fmt::format("          {}: {}\n", parameter.minimum_excluded ? "exclusiveMinimum" : "minimum",
                            *parameter.minimum);
    }
    if (parameter.maximum) text += fmt::format("          maximum: {}\n", *parameter.maximum);
    if (parameter.default_value)
        text += fmt::format("          default: {}\n", print(*parameter.default_value));
    return text;
}

std::string parameters_schema(const Algorithm& algorithm) {
    std::string text =
        fmt::format("    {}:\n      description: {}\n      type: object\n", schema_name(algorithm),
                    quote(fmt::format("Of {}: {}", algorithm.id, algorithm.title)));
    if (!algorithm.parameters.empty()) text += "      properties:\n";
    for (const Parameter& parameter : algorithm.parameters) text += parameter_schema(parameter);
    return text + "      additionalProperties: false\n";
}

std::string enumeration(std::string_view name, const std::vector<std::string>& values) {
    return fmt::format("    {}:\n      type: string\n      enum:\n{}", name, list(values));
}

std::vector<std::string> error_codes() {
    std::vector<std::string> codes;
    for (size_t i = 0; i < static_cast<size_t>(ErrorCode::count_); ++i) {
        codes.emplace_back(name(static_cast<ErrorCode>(i)));
    }
    return codes;
}

std::vector<std::string> stop_reasons() {
    std::vector<std::string> reasons;
    for (const StopReason reason :
         {StopReason::target, StopReason::error_limit, StopReason::threshold, StopReason::topology,
          StopReason::bounds, StopReason::locked, StopReason::already_smaller, StopReason::cancelled}) {
        reasons.emplace_back(name(reason));
    }
    return reasons;
}

}  // namespace

std::string generated_schemas() {
    std::vector<std::string> ids;
    std::vector<std::string> references;
    std::string parameters;
    for (const Algorithm& algorithm : algorithms()) {
        ids.emplace_back(algorithm.id);
        references.push_back(fmt::format("$ref: '#/components/schemas/{}'", schema_name(algorithm)));
        parameters += parameters_schema(algorithm);
    }
    return enumeration("AlgorithmId", ids) +
           "    Parameters:\n      description: Those of the algorithm.\n      anyOf:\n" + list(references) +
           parameters + enumeration("ErrorCode", error_codes()) + enumeration("StopReason", stop_reasons());
}

}  // namespace coppice
