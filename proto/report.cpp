#include "proto/report.h"

#include <fmt/format.h>

#include <nlohmann/json.hpp>
#include <optional>

#include "core/simplify/registry.h"
#include "proto/asset_json.h"
#include "proto/json.h"

namespace coppice {
namespace {

using Json = nlohmann::ordered_json;

Json to_json(const ParameterValue& value) {
    return std::visit([](const auto& held) -> Json { return held; }, value);
}

Json to_json(const ParameterValues& values) {
    Json json = Json::object();
    for (const auto& [id, value] : values.all()) json[id] = to_json(value);
    return json;
}

Json to_json(const StageTimes& times) {
    return {{"read", times.read},     {"discover", times.discover}, {"simplify", times.simplify},
            {"encode", times.encode}, {"write", times.write},       {"total", times.total},
            {"queue", times.queue}};
}

Json to_json(const MeshReport& mesh) {
    return {{"name", mesh.name},
            {"instances", mesh.instances},
            {"triangles_in", mesh.triangles_in},
            {"triangles_out", mesh.triangles_out},
            {"error_model_units", mesh.error_model_units},
            {"error_diagonal_fraction", mesh.error_diagonal_fraction},
            {"certified", mesh.certified},
            {"stop_reason", name(mesh.stop_reason)}};
}

Json to_json(const Savings& savings) {
    return {{"bytes_ratio", savings.bytes_ratio},
            {"bytes_vs_expanded", savings.bytes_vs_expanded},
            {"bytes_saved_by_instancing", savings.bytes_saved_by_instancing}};
}

Json to_json(const InstanceMapping& mapping) {
    return {{"node", mapping.node}, {"mesh", mapping.mesh}, {"instance", mapping.instance}};
}

Json to_json(const PrunedInstance& pruned) {
    return {{"node", pruned.node}, {"instance", pruned.instance}};
}

Json to_json(const std::optional<double>& number) {
    return number ? Json(*number) : Json(nullptr);
}

Json to_json(const Vec3d& point) {
    return Json::array({point.x, point.y, point.z});
}

// Null for a scene without any vertex: its box has no corners.
Json to_json(const Bounds& bounds) {
    if (bounds.empty()) return nullptr;
    return {{"min", to_json(bounds.min)}, {"max", to_json(bounds.max)}};
}

Json to_json(const InspectedMesh& mesh) {
    return {{"name", mesh.name},
            {"instances", mesh.instances},
            {"triangles", mesh.triangles},
            {"vertices", mesh.vertices},
            {"wedges", mesh.wedges},
            {"attributes", mesh.attributes},
            {"material_slots", mesh.material_slots},
            {"border_edges", mesh.border_edges},
            {"non_manifold_edges", mesh.non_manifold_edges}};
}

std::string_view type_name(Parameter::Kind kind) {
    switch (kind) {
        case Parameter::Kind::boolean:
            return "boolean";
        case Parameter::Kind::number:
            return "number";
        case Parameter::Kind::integer:
            return "integer";
        case Parameter::Kind::choice:
            return "choice";
        case Parameter::Kind::length:
            return "length";
        case Parameter::Kind::text:
            return "text";
    }
    return {};
}

// A whole number where it is one: 2, not 2.0.
Json number_of(Parameter::Kind kind, double value) {
    if (kind == Parameter::Kind::integer) return static_cast<int64_t>(value);
    return value;
}

Json to_json(const Parameter& parameter) {
    Json json = {{"id", parameter.id}, {"title", parameter.title}, {"type", type_name(parameter.kind)}};
    if (!parameter.unit.empty()) json["unit"] = parameter.unit;
    if (parameter.default_value) {
        const auto* number = std::get_if<double>(&*parameter.default_value);
        json["default"] = number ? number_of(parameter.kind, *number) : to_json(*parameter.default_value);
    }
    if (parameter.minimum)
        json[parameter.minimum_excluded ? "exclusive_minimum" : "minimum"] =
            number_of(parameter.kind, *parameter.minimum);
    if (parameter.maximum) json["maximum"] = number_of(parameter.kind, *parameter.maximum);
    if (!parameter.choices.empty()) json["choices"] = parameter.choices;
    if (!parameter.pattern.empty()) json["pattern"] = fmt::format("^(?:{})$", parameter.pattern);
    return json;
}

Json to_json(const Algorithm& algorithm);

template <typename Items>
Json list(const Items& items) {
    Json json = Json::array();
    for (const auto& item : items) json.push_back(to_json(item));
    return json;
}

Json to_json(const InstancingReport& instancing) {
    return {{"given", instancing.given},
            {"discovered", instancing.discovered},
            {"unique", instancing.unique},
            {"map", list(instancing.map)},
            {"pruned", list(instancing.pruned)}};
}

Json to_json(const Algorithm& algorithm) {
    return {{"id", algorithm.id},
            {"title", algorithm.title},
            {"citation", algorithm.citation},
            {"instance_aware", algorithm.instance_aware},
            {"parameters", list(algorithm.parameters)}};
}

}  // namespace

std::string print_report(const Report& report) {
    Json json;
    json["algorithm"] = {{"id", report.algorithm}, {"parameters", to_json(report.parameters)}};
    json["input"] = to_json(report.input);
    json["output"] = to_json(report.output);
    json["timing_ms"] = to_json(report.timing_ms);
    json["meshes"] = list(report.meshes);
    json["savings"] = to_json(report.savings);
    json["instancing"] = to_json(report.instancing);
    json["warnings"] = list(report.warnings);
    json["budget"] = report.budget;
    json["thresholds_used"] = list(report.thresholds_used);
    json["reused_meshes"] = report.reused_meshes;
    json["engine"] = {{"version", report.engine_version}, {"build", report.engine_build}};
    return print_json(json);
}

std::string print_inspection(const Inspection& inspection) {
    Json json;
    json["summary"] = to_json(inspection.summary);
    json["bounds"] = to_json(inspection.bounds);
    json["meshes"] = list(inspection.meshes);
    json["materials"] = inspection.materials;
    json["images"] = inspection.images;
    json["nodes"] = inspection.nodes;
    json["bytes_saved_by_instancing"] = inspection.bytes_saved_by_instancing;
    json["warnings"] = list(inspection.warnings);
    return print_json(json);
}

std::string print_algorithms() {
    Json json;
    json["default_algorithm"] = default_algorithm().id;
    json["algorithms"] = list(algorithms());
    return print_json(json);
}

}  // namespace coppice
