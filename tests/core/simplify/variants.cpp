#include "tests/core/simplify/variants.h"

#include <algorithm>
#include <cmath>
#include <ostream>
#include <span>
#include <utility>

namespace coppice::test {

namespace {

// Parameters whose values are ways to work.
bool is_mode(const Parameter& p) {
    return p.id == "mode" || p.id == "stitch" || p.id == "borders" || p.id == "quality";
}

}  // namespace

std::ostream& operator<<(std::ostream& out, const Variant& variant) {
    out << variant.algorithm;
    for (const auto& [id, value] : variant.parameters)
        out << ' ' << id << '=' << std::get<std::string>(value);
    return out;
}

std::string test_name(const Variant& variant, const std::string& shape) {
    std::string name = variant.algorithm;
    for (const auto& [id, value] : variant.parameters) name += "_" + id + "_" + std::get<std::string>(value);
    name += "_" + shape;
    std::replace(name.begin(), name.end(), '-', '_');
    return name;
}

std::vector<Variant> variants() {
    std::vector<Variant> list = {{"quadric", {{"pair_distance", "1"}}}};  // else it joins nothing
    for (const Algorithm& a : algorithms()) {
        list.push_back({std::string(a.id)});
        for (const Parameter& p : a.parameters) {
            if (!is_mode(p)) continue;
            for (const std::string_view mode : p.choices) {
                if (ParameterValue(std::string(mode)) == *p.default_value || mode == p.unguarded_choice)
                    continue;
                list.push_back({std::string(a.id), {{std::string(p.id), std::string(mode)}}});
            }
        }
    }
    return list;
}

std::vector<Variant> unguarded_variants() {
    std::vector<Variant> list;
    for (const Algorithm& a : algorithms()) {
        for (const Parameter& p : a.parameters) {
            if (p.unguarded_choice.empty()) continue;
            list.push_back({std::string(a.id), {{std::string(p.id), std::string(p.unguarded_choice)}}});
        }
    }
    return list;
}

std::vector<Variant> all_variants() {
    std::vector<Variant> list = variants();
    for (Variant& unguarded : unguarded_variants()) list.push_back(std::move(unguarded));
    return list;
}

Simplified simplify(const Variant& variant, const Mesh& mesh, const Target& target, const Watch& watch) {
    const Algorithm& a = find_algorithm(variant.algorithm);
    const ParameterValues values = ParameterValues::parse(a.parameters, variant.parameters);
    if (a.simplify_scene == nullptr) return a.simplify(mesh, {}, target, values, watch);
    const std::vector<std::vector<Transform>> one_instance = {{Transform{}}};
    const SceneTarget scene = {.triangles = target.triangles, .of_mesh = {target}};
    return a.simplify_scene(std::span(&mesh, 1), one_instance, scene, values, watch).meshes.front();
}

Target part_of(const Mesh& mesh, double ratio) {
    return {.triangles =
                static_cast<uint64_t>(std::floor(ratio * static_cast<double>(mesh.triangle_count())))};
}

}  // namespace coppice::test
