#include <algorithm>
#include <cmath>
#include <map>
#include <set>

#include "core/format/gltf/checks.h"
#include "core/format/gltf/semantics.h"

namespace coppice::gltf {

namespace {

constexpr double unit_tolerance = 0.00674;  // as Khronos' validator has it

// The pass over the vertex data; each accessor is looked at once per thing it is used for.
class VertexCheck {
  public:
    VertexCheck(Parsed& parsed, const ReadLimits& limits, const Watch& watch)
        : parsed_(parsed), limits_(limits), watch_(watch), index_ends_(parsed.accessors.size()) {}

    void primitive(const Json& primitive, const Pointer& where) {
        if (extension(primitive, "KHR_draco_mesh_compression") != nullptr) return;
        for (const auto& [name, accessor] : primitive["attributes"].items())
            attribute(name, accessor.get<uint32_t>(), false, where / "attributes" / name);
        const Json& targets = list(primitive, "targets");
        for (size_t t = 0; t < targets.size(); ++t)
            for (const auto& [name, accessor] : targets[t].items())
                attribute(name, accessor.get<uint32_t>(), true, where / "targets" / t / name);
        if (!primitive.contains("indices")) return;
        const uint64_t vertices = parsed_.accessors[primitive["attributes"].begin()->get<uint32_t>()].count;
        indices(*index_at(primitive, "indices"), vertices, where / "indices");
    }

    void influences(const Json& primitive, size_t joint_count, const Pointer& where) {
        std::vector<uint32_t> accessors;
        for (const char* prefix : {"JOINTS_", "WEIGHTS_"})
            for (size_t set = 0; primitive["attributes"].contains(prefix + std::to_string(set)); ++set)
                accessors.push_back(primitive["attributes"][prefix + std::to_string(set)].get<uint32_t>());
        if (accessors.empty() || extension(primitive, "KHR_draco_mesh_compression") != nullptr) return;
        if (std::any_of(accessors.begin(), accessors.end(),
                        [&](uint32_t index) { return parsed_.accessors[index].has_no_data(); }))
            return;
        std::vector<uint32_t> key = accessors;
        key.push_back(static_cast<uint32_t>(joint_count));
        if (!seen_influences_.insert(key).second) return;
        demand_influences_within_limit(accessors, where);
        for (uint64_t v = 0; v < parsed_.accessors[accessors[0]].count; ++v) {
            if (v % 65536 == 0) watch_.check();
            vertex_influences(accessors, v, joint_count, where);
        }
    }

  private:
    void attribute(std::string_view name, uint32_t index, bool is_delta, const Pointer& where) {
        const Semantic semantic = parse_attribute_name(name).semantic;
        // What is used as a position, too, must not be repaired.
        const bool repairable = semantic == Semantic::normal || semantic == Semantic::tangent ||
                                semantic == Semantic::texcoord || semantic == Semantic::color;
        if (repairable && !refused_.contains(index))
            parsed_.repairs[index].zero_non_finite = true;
        else if (!repairable) {
            refused_.insert(index);
            parsed_.repairs[index].zero_non_finite = false;
        }
        if (is_delta || !seen_.insert({index, semantic}).second) return;
        const bool is_vector = semantic == Semantic::normal || semantic == Semantic::tangent;
        if (is_vector) unit_vectors(index, semantic == Semantic::tangent, where);
        if (semantic == Semantic::color) colors(index, where);
    }

    void unit_vectors(uint32_t index, bool is_tangent, const Pointer& where) {
        const Accessor& accessor = parsed_.accessors[index];
        if (accessor.has_no_data()) return;
        uint64_t wrong = 0;
        for (uint64_t i = 0; i < accessor.count; ++i) {
            if (i % 65536 == 0) watch_.check();
            double sum = 0;
            for (uint32_t c = 0; c < 3; ++c) {
                const double v = accessor.value(i, c);
                sum += v * v;
            }
            wrong += !(std::abs(std::sqrt(sum) - 1) <= unit_tolerance);
            if (!is_tangent) continue;
            const double sign = accessor.value(i, 3);
            demand(sign == 1 || sign == -1, where,
                   "is accessor {}, whose element {} has w = {}; it must be 1 or -1", index, i, sign);
        }
        if (wrong == 0) return;
        parsed_.repairs[index].unit_vector = true;
        parsed_.warn("repair.normals",
                     fmt::format("{} vectors of {} had not the length 1; they were given it", wrong, where),
                     where);
    }

    void colors(uint32_t index, const Pointer& where) {
        const Accessor& accessor = parsed_.accessors[index];
        if (accessor.storage.type != ComponentType::float32) return;
        for (uint64_t i = 0; i < accessor.count; ++i) {
            if (i % 65536 == 0) watch_.check();
            for (uint32_t c = 0; c < accessor.rows; ++c) {
                const double v = accessor.value(i, c);
                demand(!std::isfinite(v) || (v >= 0 && v <= 1), where,
                       "is accessor {}, whose element {} is {}; colours must lie in 0 to 1", index, i, v);
            }
        }
    }

    void indices(uint32_t index, uint64_t vertices, const Pointer& where) {
        const Accessor& accessor = parsed_.accessors[index];
        if (!index_ends_[index]) index_ends_[index] = end_of(accessor, index, where);
        if (*index_ends_[index] <= vertices) return;
        uint64_t i = 0;
        while (accessor.integer(i) < vertices) ++i;
        refuse(where, "is accessor {}, whose element {} is {}, but there are {} vertices", index, i,
               accessor.integer(i), vertices);
    }

    // One past the largest index.
    uint64_t end_of(const Accessor& accessor, uint32_t index, const Pointer& where) const {
        const uint64_t restart = (uint64_t{1} << (8 * size_of(accessor.storage.type))) - 1;
        uint64_t end = 0;
        for (uint64_t i = 0; i < accessor.count; ++i) {
            if (i % 65536 == 0) watch_.check();
            const uint32_t vertex = accessor.integer(i);
            demand(vertex != restart, where,
                   "is accessor {}, whose element {} is {}, which restarts primitives", index, i, vertex);
            end = std::max(end, uint64_t{vertex} + 1);
        }
        return end;
    }

    // Accessors may be combined in more ways than there are accessors.
    void demand_influences_within_limit(const std::vector<uint32_t>& accessors, const Pointer& where) {
        for (const uint32_t index : accessors)
            influence_bytes_ += parsed_.accessors[index].count * parsed_.accessors[index].tight_stride();
        require(
            influence_bytes_ <= limits_.attribute_bytes, ErrorCode::asset_too_large, where,
            "the skinned primitives have more than {} bytes of joints and weights (limit attribute_bytes)",
            limits_.attribute_bytes);
    }

    // accessors: joints, then as many weights.
    void vertex_influences(const std::vector<uint32_t>& accessors, uint64_t vertex, size_t joint_count,
                           const Pointer& where) {
        std::set<uint32_t> used;
        float sum = 0;
        float tolerance = 0;
        const size_t sets = accessors.size() / 2;
        for (uint32_t c = 0; c < 4; ++c)
            for (size_t set = 0; set < sets; ++set) {
                const auto joint = static_cast<uint32_t>(parsed_.accessors[accessors[set]].raw(vertex, c));
                const float weight = parsed_.accessors[accessors[sets + set]].value(vertex, c);
                demand(joint < joint_count, where, "has joint {} at vertex {}, but the skin has {} joints",
                       joint, vertex, joint_count);
                if (weight == 0) continue;
                demand(used.insert(joint).second, where, "has joint {} twice at vertex {}", joint, vertex);
                demand(weight > 0, where, "has the weight {} at vertex {}; it must not be negative", weight,
                       vertex);
                sum += weight;
                tolerance += 2e-7F;
            }
        demand(std::abs(sum - 1) <= tolerance, where,
               "has weights at vertex {} whose sum is {}; it must be 1", vertex, sum);
    }

    Parsed& parsed_;
    const ReadLimits& limits_;
    const Watch& watch_;
    std::set<uint32_t> refused_;
    std::set<std::pair<uint32_t, Semantic>> seen_;
    std::vector<std::optional<uint64_t>> index_ends_;  // per accessor, once it was looked at
    uint64_t influence_bytes_ = 0;
    std::set<std::vector<uint32_t>> seen_influences_;
};

// The fewest joints of the skins that a mesh is used with.
std::map<uint32_t, size_t> joints_per_mesh(const Json& document) {
    std::map<uint32_t, size_t> joints;
    for (const Json& node : list(document, "nodes")) {
        const auto mesh = index_at(node, "mesh");
        const auto skin = index_at(node, "skin");
        if (!mesh || !skin) continue;
        const size_t count = document["skins"][*skin]["joints"].size();
        const auto [found, is_new] = joints.try_emplace(*mesh, count);
        found->second = std::min(found->second, count);
    }
    return joints;
}

}  // namespace

void check_vertex_data(Parsed& parsed, const ReadLimits& limits, const Watch& watch) {
    VertexCheck check(parsed, limits, watch);
    const Json& meshes = list(parsed.json, "meshes");
    const std::map<uint32_t, size_t> joints = joints_per_mesh(parsed.json);
    for (uint32_t m = 0; m < meshes.size(); ++m)
        for (size_t p = 0; p < meshes[m]["primitives"].size(); ++p) {
            watch.check();
            const Pointer where = pointer("meshes", m, "primitives", p);
            check.primitive(meshes[m]["primitives"][p], where);
            if (const auto found = joints.find(m); found != joints.end())
                check.influences(meshes[m]["primitives"][p], found->second, where / "attributes");
        }
}

}  // namespace coppice::gltf
