#include "core/simplify/parameter.h"

#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <regex>

#include "core/base/error.h"
#include "core/base/number.h"

namespace coppice {

namespace {

std::string print(const ParameterValue& value) {
    if (const bool* b = std::get_if<bool>(&value)) return *b ? "true" : "false";
    if (const double* d = std::get_if<double>(&value)) return fmt::format("{}", *d);
    return fmt::format("\"{}\"", std::get<std::string>(value));
}

// "a number from 0 to 1", "a number greater than 0 (mesh units)".
std::string describe_number(const Parameter& p) {
    std::string text = p.kind == Parameter::Kind::integer ? "a whole number" : "a number";
    if (p.minimum) text += fmt::format("{} {}", p.minimum_excluded ? " greater than" : " from", *p.minimum);
    if (p.maximum)
        text += fmt::format("{} {}", p.minimum && !p.minimum_excluded ? " to" : " up to", *p.maximum);
    if (p.minimum && !p.minimum_excluded && !p.maximum) text += " up";
    if (!p.unit.empty()) text += fmt::format(" ({})", p.unit);
    return text;
}

std::string describe(const Parameter& p) {
    switch (p.kind) {
        case Parameter::Kind::boolean:
            return "true or false";
        case Parameter::Kind::choice:
            return fmt::format("one of {}", fmt::join(p.choices, ", "));
        case Parameter::Kind::text:
            return std::string(p.form);
        case Parameter::Kind::length:
            return describe_number(p) + ", or one with the suffix u (mesh units)";
        default:
            return describe_number(p);
    }
}

bool in_range(const Parameter& p, double number) {
    if (!std::isfinite(number)) return false;
    if (p.kind == Parameter::Kind::integer && number != std::floor(number)) return false;
    if (p.minimum && (p.minimum_excluded ? number <= *p.minimum : number < *p.minimum)) return false;
    return !p.maximum || number <= *p.maximum;
}

std::optional<ParameterValue> parse_boolean(const ParameterValue& given) {
    if (std::holds_alternative<bool>(given)) return given;
    const std::string* text = std::get_if<std::string>(&given);
    if (text && *text == "true") return true;
    if (text && *text == "false") return false;
    return {};
}

std::optional<ParameterValue> parse_number(const Parameter& p, const ParameterValue& given) {
    std::optional<double> number;
    if (const double* d = std::get_if<double>(&given)) number = *d;
    if (const std::string* text = std::get_if<std::string>(&given)) number = coppice::parse_number(*text);
    if (!number || !in_range(p, *number)) return {};
    return *number;
}

std::optional<ParameterValue> parse_choice(const Parameter& p, const ParameterValue& given) {
    const std::string* text = std::get_if<std::string>(&given);
    if (!text || std::find(p.choices.begin(), p.choices.end(), *text) == p.choices.end()) return {};
    return given;
}

// "0.85", or "0.01u" for mesh units; the latter is kept as text.
std::optional<ParameterValue> parse_length(const Parameter& p, const ParameterValue& given) {
    const std::string* text = std::get_if<std::string>(&given);
    if (!text || !text->ends_with('u')) return parse_number(p, given);
    const std::optional<ParameterValue> number = parse_number(p, text->substr(0, text->size() - 1));
    return number ? std::optional(given) : std::nullopt;
}

// Longer ones match no pattern that we have, and would only cost.
constexpr size_t longest_text = 64;

// JSON may hold a whole number where a text is asked for ("all, or a number").
std::optional<ParameterValue> parse_text(const Parameter& p, const ParameterValue& given) {
    std::string text;
    if (const auto* held = std::get_if<std::string>(&given)) text = *held;
    if (const auto* number = std::get_if<double>(&given)) text = fmt::format("{}", *number);
    if (text.size() > longest_text || !std::regex_match(text, std::regex(std::string(p.pattern)))) return {};
    return text;
}

std::optional<ParameterValue> parse_value(const Parameter& p, const ParameterValue& given) {
    switch (p.kind) {
        case Parameter::Kind::boolean:
            return parse_boolean(given);
        case Parameter::Kind::choice:
            return parse_choice(p, given);
        case Parameter::Kind::length:
            return parse_length(p, given);
        case Parameter::Kind::text:
            return parse_text(p, given);
        default:
            return parse_number(p, given);
    }
}

const Parameter& find(std::span<const Parameter> parameters, const std::string& id) {
    const auto found =
        std::find_if(parameters.begin(), parameters.end(), [&id](const Parameter& p) { return p.id == id; });
    if (found != parameters.end()) return *found;
    std::vector<std::string_view> ids;
    for (const Parameter& p : parameters) ids.push_back(p.id);
    const std::string name = "parameters." + id.substr(0, 64);
    fail(ErrorCode::option_unknown, name,
         ids.empty() ? fmt::format("{} is not a parameter; this algorithm takes none", name)
                     : fmt::format("{} is not a parameter of this algorithm, which takes {}", name,
                                   fmt::join(ids, ", ")));
}

template <typename T>
const T* get(const std::map<std::string, ParameterValue, std::less<>>& values, std::string_view id) {
    const auto found = values.find(id);
    return found == values.end() ? nullptr : std::get_if<T>(&found->second);
}

}  // namespace

ParameterValues ParameterValues::parse(std::span<const Parameter> parameters,
                                       const std::map<std::string, ParameterValue>& given) {
    ParameterValues parsed;
    for (const Parameter& p : parameters) {
        if (p.default_value) parsed.values_.emplace(p.id, *p.default_value);
    }
    for (const auto& [id, text] : given) {
        const Parameter& p = find(parameters, id);
        const std::optional<ParameterValue> value = parse_value(p, text);
        require(value.has_value(), ErrorCode::option_invalid, "parameters." + id,
                "parameters.{} is {}; it takes {}", id, print(text), describe(p));
        parsed.values_.insert_or_assign(id, *value);
    }
    return parsed;
}

std::optional<double> ParameterValues::number(std::string_view id) const {
    const double* value = get<double>(values_, id);
    return value ? std::optional(*value) : std::nullopt;
}

bool ParameterValues::boolean(std::string_view id) const {
    const bool* value = get<bool>(values_, id);
    return value && *value;
}

std::string_view ParameterValues::text(std::string_view id) const {
    const std::string* value = get<std::string>(values_, id);
    return value ? std::string_view(*value) : std::string_view();
}

std::optional<Length> ParameterValues::length(std::string_view id) const {
    if (const double* value = get<double>(values_, id)) return Length{*value, false};
    const std::string* text = get<std::string>(values_, id);
    if (!text || !text->ends_with('u')) return {};
    return Length{coppice::parse_number(text->substr(0, text->size() - 1)).value_or(0), true};
}

}  // namespace coppice
