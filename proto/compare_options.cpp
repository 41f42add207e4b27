#include "proto/compare_options.h"

#include <array>
#include <nlohmann/json.hpp>
#include <set>

#include "core/base/error.h"
#include "proto/given_option.h"
#include "proto/json.h"
#include "proto/unknown_option.h"

namespace coppice {
namespace {

template <auto member, auto read>
void set(const Given& given, std::string_view takes, CompareOptions& options) {
    options.*member = read(given, takes);
}

struct Rule {
    std::string_view name;
    std::string_view takes;
    void (*apply)(const Given& given, std::string_view takes, CompareOptions& options);
};

constexpr auto rules = std::to_array<Rule>({
    {"samples", "a number from 1 to 10000, of samples for each triangle",
     set<&CompareOptions::samples, number>},
    {"seed", "a whole number, which chooses the samples", set<&CompareOptions::seed, whole_number>},
    {"self_intersections", "true or false", set<&CompareOptions::self_intersections, boolean>},
    {"reference_entry", "the path of a file in the reference's archive",
     set<&CompareOptions::reference_entry, text>},
    {"candidate_entry", "the path of a file in the candidate's archive",
     set<&CompareOptions::candidate_entry, text>},
});

void apply(const Given& given, CompareOptions& options) {
    std::vector<std::string_view> names;
    for (const Rule& rule : rules) {
        if (rule.name == given.name) return rule.apply(given, rule.takes, options);
        names.push_back(rule.name);
    }
    fail_unknown_option(given.name, names);
}

}  // namespace

CompareOptions parse_compare_options(const std::vector<std::pair<std::string, std::string>>& pairs) {
    CompareOptions options;
    std::set<std::string_view> seen;
    for (const auto& [name, value] : pairs) {
        require(seen.insert(name).second, ErrorCode::option_conflict, name, "{} is given twice; give it once",
                name);
        apply(given_in_text(name, value), options);
    }
    validate(options);
    return options;
}

CompareOptions parse_compare_options_json(std::string_view json) {
    const nlohmann::json object = parse_json(json, {}, "options");
    require(object.is_object(), ErrorCode::option_invalid, "options",
            "options is {}; it takes an object, such as {{\"samples\":20}}", shorten(print_json(object)));
    CompareOptions options;
    for (const auto& [name, value] : object.items()) apply(given_in_json(name, value), options);
    validate(options);
    return options;
}

std::vector<OptionDescription> describe_compare_options() {
    std::vector<OptionDescription> out;
    for (const Rule& rule : rules) out.push_back({rule.name, rule.takes});
    return out;
}

std::string print_compare_options(const CompareOptions& options) {
    const CompareOptions defaults;
    nlohmann::json json = nlohmann::json::object();
    if (options.samples != defaults.samples) json["samples"] = options.samples;
    if (options.seed != defaults.seed) json["seed"] = options.seed;
    if (options.self_intersections) json["self_intersections"] = true;
    if (!options.reference_entry.empty()) json["reference_entry"] = options.reference_entry;
    if (!options.candidate_entry.empty()) json["candidate_entry"] = options.candidate_entry;
    return print_json(json);
}

}  // namespace coppice
