#include "proto/options.h"

#include <array>
#include <nlohmann/json.hpp>
#include <optional>
#include <variant>

#include "core/base/error.h"
#include "core/simplify/registry.h"
#include "proto/given_option.h"
#include "proto/json.h"
#include "proto/unknown_option.h"

namespace coppice {
namespace {

constexpr auto instancings = std::to_array<std::pair<Instancing, std::string_view>>({
    {Instancing::automatic, "auto"},
    {Instancing::nodes, "nodes"},
    {Instancing::expand, "expand"},
});

std::string_view name(Instancing instancing) {
    for (const auto& [candidate, text] : instancings) {
        if (candidate == instancing) return text;
    }
    return {};
}

Instancing to_instancing(const Given& given, std::string_view takes) {
    const std::string& wanted = text(given, takes);
    for (const auto& [instancing, candidate] : instancings) {
        if (candidate == wanted) return instancing;
    }
    refuse(given, takes);
}

Format to_format(const Given& given, std::string_view takes) {
    const auto format = format_from_id(text(given, takes));
    if (!format || !is_writable(*format)) refuse(given, takes);
    return *format;
}

// Finding copies does not exist yet; the option that turns it off does, so that requests stay right when it
// comes.
void check_discover(const Given& given, std::string_view takes, OptimizeOptions& /*options*/) {
    if (text(given, takes) != "none") refuse(given, takes);
}

using Apply = void (*)(const Given& given, std::string_view takes, OptimizeOptions& options);

template <auto member, auto read>
void set(const Given& given, std::string_view takes, OptimizeOptions& options) {
    options.*member = read(given, takes);
}

struct Rule {
    std::string_view name;
    std::string_view takes;
    Apply apply;
};

// Ranges are checked by validate(), which guards every caller of the library.
constexpr auto rules = std::to_array<Rule>({
    {"algorithm", "the id of an algorithm, as GET /v1/algorithms lists them",
     set<&OptimizeOptions::algorithm, text>},
    {"ratio", "a number over 0 and at most 1", set<&OptimizeOptions::ratio, number>},
    {"triangles", "a whole number of at least 1", set<&OptimizeOptions::triangles, whole_number>},
    {"error", "a number over 0, as a fraction of the scene's diagonal", set<&OptimizeOptions::error, number>},
    {"format", "glb, gltf, obj or iobj", set<&OptimizeOptions::format, to_format>},
    {"instancing", "auto, nodes or expand", set<&OptimizeOptions::instancing, to_instancing>},
    {"discover", "none, because this version does not find copies yet", check_discover},
    {"entry", "the path of a file in the archive", set<&OptimizeOptions::entry, text>},
});

constexpr std::string_view parameter_prefix = "parameters.";

std::vector<std::string_view> option_names(JobKind kind) {
    if (kind == JobKind::inspect) return {"entry"};
    std::vector<std::string_view> names;
    names.reserve(rules.size() + 1);
    for (const Rule& rule : rules) names.push_back(rule.name);
    names.emplace_back("parameters");
    return names;
}

// An inspection changes nothing: only the option that chooses the asset means anything.
void check_taken(const Given& given, JobKind kind) {
    require(kind == JobKind::optimize || given.name == "entry", ErrorCode::option_invalid, given.name,
            "{} is an option of optimizing; an inspection takes entry alone", given.name);
}

void apply(const Given& given, JobKind kind, OptimizeOptions& options) {
    if (given.name.starts_with(parameter_prefix)) {
        check_taken(given, kind);
        options.parameters[given.name.substr(parameter_prefix.size())] = given.value;
        return;
    }
    for (const Rule& rule : rules) {
        if (rule.name != given.name) continue;
        check_taken(given, kind);
        return rule.apply(given, rule.takes, options);
    }
    fail_unknown_option(given.name, option_names(kind));
}

// Typed, so that options which mean the same print the same wherever they came from.
void resolve_parameters(bool is_json, OptimizeOptions& options) {
    const Algorithm& algorithm =
        options.algorithm.empty() ? default_algorithm() : find_algorithm(options.algorithm);
    const ParameterValues values = ParameterValues::parse(algorithm.parameters, options.parameters);
    for (auto& [id, value] : options.parameters) {
        const ParameterValue& typed = values.all().find(id)->second;
        require(!is_json || typed.index() == value.index(), ErrorCode::option_invalid, "parameters." + id,
                "parameters.{0} is the text \"{1}\"; in JSON it is given without quotes", id,
                std::holds_alternative<std::string>(value) ? std::get<std::string>(value) : "");
        value = typed;
    }
}

OptimizeOptions finish(bool is_json, OptimizeOptions options) {
    validate(options);
    resolve_parameters(is_json, options);
    return options;
}

void apply_parameters(const nlohmann::json& parameters, JobKind kind, OptimizeOptions& options) {
    require(parameters.is_object(), ErrorCode::option_invalid, "parameters",
            "parameters is {}; it takes an object with the algorithm's own parameters",
            shorten(print_json(parameters)));
    for (const auto& [id, value] : parameters.items())
        apply(given_in_json(fmt::format("parameters.{}", id), value), kind, options);
}

}  // namespace

OptimizeOptions parse_options(const std::vector<std::pair<std::string, std::string>>& pairs, JobKind kind) {
    OptimizeOptions options;
    std::map<std::string_view, std::string_view> seen;
    for (const auto& [name, value] : pairs) {
        const auto [earlier, is_new] = seen.emplace(name, value);
        require(is_new, ErrorCode::option_conflict, name, "{} is given twice, as {} and {}; give it once",
                name, shorten(std::string(earlier->second)), shorten(value));
        require(name != "parameters", ErrorCode::option_invalid, name,
                "parameters takes an object in JSON only; here each parameter is an option of its own, "
                "parameters.NAME");
        apply(given_in_text(name, value), kind, options);
    }
    return finish(false, std::move(options));
}

OptimizeOptions parse_options_json(std::string_view json, JobKind kind) {
    const nlohmann::json object = parse_json(json, {}, "options");
    require(object.is_object(), ErrorCode::option_invalid, "options",
            "options is {}; it takes an object, such as {{\"ratio\":0.5}}", shorten(print_json(object)));
    OptimizeOptions options;
    for (const auto& [name, value] : object.items()) {
        if (name == "parameters") {
            apply_parameters(value, kind, options);
            continue;
        }
        require(!name.starts_with(parameter_prefix), ErrorCode::option_invalid, name,
                "{} is how a query names a parameter; in JSON, parameters is an object", name);
        apply(given_in_json(name, value), kind, options);
    }
    return finish(true, std::move(options));
}

std::vector<OptionDescription> describe_options() {
    std::vector<OptionDescription> out;
    for (const Rule& rule : rules) out.push_back({rule.name, rule.takes});
    return out;
}

std::string print_options(const OptimizeOptions& options) {
    nlohmann::json json = nlohmann::json::object();
    if (!options.algorithm.empty()) json["algorithm"] = options.algorithm;
    if (options.ratio) json["ratio"] = *options.ratio;
    if (options.triangles) json["triangles"] = *options.triangles;
    if (options.error) json["error"] = *options.error;
    if (options.format) json["format"] = id(*options.format);
    if (options.instancing != Instancing::automatic) json["instancing"] = name(options.instancing);
    if (!options.entry.empty()) json["entry"] = options.entry;
    for (const auto& [id, value] : options.parameters) {
        std::visit([&, &id = id](const auto& held) { json["parameters"][id] = held; }, value);
    }
    return print_json(json);
}

}  // namespace coppice
