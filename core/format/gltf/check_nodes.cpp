#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <set>

#include "core/format/gltf/checks.h"
#include "core/format/gltf/trs.h"

namespace coppice::gltf {

namespace {

constexpr uint32_t none = UINT32_MAX;
constexpr double quaternion_tolerance = 0.00769;  // as Khronos' validator has it

std::vector<uint32_t> parents_of(const Json& nodes, const Watch& watch) {
    std::vector<uint32_t> parents(nodes.size(), none);
    for (size_t i = 0; i < nodes.size(); ++i) {
        watch.check();
        const Json& children = list(nodes[i], "children");
        for (size_t c = 0; c < children.size(); ++c) {
            const auto child = children[c].get<uint32_t>();
            demand(parents[child] == none, pointer("nodes", i, "children", c),
                   "is node {}, which is already a child of node {}", child, parents[child]);
            parents[child] = static_cast<uint32_t>(i);
        }
    }
    return parents;
}

// Levels from the root of each, 1 at the root. Every node has at most one parent here, so a walk up that
// never ends is a loop.
std::vector<uint32_t> depths_of(const std::vector<uint32_t>& parents, const ReadLimits& limits,
                                const Watch& watch) {
    std::vector<uint32_t> depth(parents.size(), 0);
    std::vector<uint32_t> path;
    for (uint32_t start = 0; start < parents.size(); ++start) {
        watch.check();
        path.clear();
        for (uint32_t node = start; node != none && depth[node] == 0; node = parents[node]) {
            demand(path.size() < parents.size(), pointer("nodes", start),
                   "is part of a loop of children; no node may be its own ancestor");
            path.push_back(node);
        }
        for (size_t i = path.size(); i-- > 0;) {
            depth[path[i]] = parents[path[i]] == none ? 1 : depth[parents[path[i]]] + 1;
            const Pointer where = pointer("nodes", path[i]);
            require(depth[path[i]] <= limits.node_depth, ErrorCode::asset_too_large, where,
                    "{} is deeper than {} levels (limit node_depth)", where, limits.node_depth);
        }
    }
    return depth;
}

// Who hangs under whom.
struct Tree {
    std::vector<uint32_t> parents;  // none for roots
    std::vector<uint32_t> depths;
};

Tree tree_of(const Json& document, const ReadLimits& limits, const Watch& watch) {
    Tree tree;
    tree.parents = parents_of(list(document, "nodes"), watch);
    tree.depths = depths_of(tree.parents, limits, watch);
    return tree;
}

void check_transform(Parsed& parsed, size_t index) {
    Json& node = parsed.json["nodes"][index];
    const Pointer where = pointer("nodes", index);
    if (node.contains("matrix")) {
        demand(!node.contains("translation") && !node.contains("rotation") && !node.contains("scale"),
               where / "matrix", "stands beside translation, rotation or scale; a node has one or the other");
        demand(is_valid_node_matrix(node["matrix"].get<std::array<double, 16>>()), where / "matrix",
               "cannot be split into translation, rotation and scale");
    }
    if (!node.contains("rotation")) return;
    auto q = node["rotation"].get<std::array<double, 4>>();
    const double length = std::sqrt(q[0] * q[0] + q[1] * q[1] + q[2] * q[2] + q[3] * q[3]);
    if (std::abs(length - 1) <= quaternion_tolerance) return;
    demand(length > 1e-6, where / "rotation", "is a quaternion of length {}; it must be 1", length);
    for (double& v : q) v /= length;
    node["rotation"] = q;
    parsed.warn("repair.rotation",
                fmt::format("{} had a rotation of length {}; it was made 1", where, length),
                where / "rotation");
}

size_t target_count(const Json& document, uint32_t mesh) {
    return list(document["meshes"][mesh]["primitives"][0], "targets").size();
}

void check_mesh_use(const Json& document, size_t index, const std::vector<bool>& has_joints) {
    const Json& node = document["nodes"][index];
    const auto mesh = index_at(node, "mesh");
    const Pointer where = pointer("nodes", index);
    for (const char* property : {"skin", "weights"})
        demand(mesh || !node.contains(property), where / property, "is there, but the node has no mesh");
    if (!mesh) return;
    if (node.contains("weights"))
        demand(node["weights"].size() == target_count(document, *mesh), where / "weights",
               "has {} numbers, but mesh {} has {} morph targets", node["weights"].size(), *mesh,
               target_count(document, *mesh));
    demand(has_joints[*mesh] || !node.contains("skin"), where / "skin",
           "is there, but mesh {} has no JOINTS_0", *mesh);
}

std::vector<bool> meshes_with_joints(const Json& document) {
    std::vector<bool> out;
    for (const Json& mesh : list(document, "meshes"))
        out.push_back(
            std::any_of(mesh["primitives"].begin(), mesh["primitives"].end(),
                        [](const Json& primitive) { return primitive["attributes"].contains("JOINTS_0"); }));
    return out;
}

void check_scenes(const Json& document, const std::vector<uint32_t>& parents, const Watch& watch) {
    const Json& scenes = list(document, "scenes");
    for (size_t s = 0; s < scenes.size(); ++s) {
        watch.check();
        const Json& roots = list(scenes[s], "nodes");
        for (size_t i = 0; i < roots.size(); ++i) {
            const auto root = roots[i].get<uint32_t>();
            demand(parents[root] == none, pointer("scenes", s, "nodes", i),
                   "is node {}, which is not a root: it is a child of node {}", root, parents[root]);
        }
    }
}

uint32_t root_of(const std::vector<uint32_t>& parents, uint32_t node) {
    while (parents[node] != none) node = parents[node];
    return node;
}

// The lowest node that is, or is above, both; none where they hang under different roots.
uint32_t common_ancestor(const Tree& tree, uint32_t a, uint32_t b) {
    while (a != b && a != none && b != none) {
        uint32_t& deeper = tree.depths[a] >= tree.depths[b] ? a : b;
        deeper = tree.parents[deeper];
    }
    return a == b ? a : none;
}

// Joints of a skin hang under one node; the skeleton, if given, is such a node.
void check_joints(const Json& skin, const Tree& tree, const Pointer& where, const Watch& watch) {
    const Json& joints = skin["joints"];
    auto common = joints[0].get<uint32_t>();
    for (const Json& joint : joints) {
        watch.check();
        common = common_ancestor(tree, common, joint.get<uint32_t>());
        demand(common != none, where / "joints", "do not hang under one common root node");
    }
    const auto skeleton = index_at(skin, "skeleton");
    demand(!skeleton || common_ancestor(tree, *skeleton, common) == *skeleton, where / "skeleton",
           "is node {}, which is not above all joints", skeleton.value_or(0));
}

// seen: whose values were looked at for another skin.
void check_inverse_bind(Parsed& parsed, const Json& skin, const Pointer& skin_pointer,
                        std::set<uint32_t>& seen) {
    const auto index = index_at(skin, "inverseBindMatrices");
    if (!index) return;
    const Pointer where = skin_pointer / "inverseBindMatrices";
    set_usage(parsed, *index, Usage::inverse_bind, where);
    const Accessor& accessor = parsed.accessors[*index];
    demand(accessor.columns == 4 && accessor.storage.type == ComponentType::float32, where,
           "is accessor {}, which must be MAT4 of 32-bit floats", *index);
    demand(accessor.count >= skin["joints"].size(), where, "is accessor {} with {} matrices for {} joints",
           *index, accessor.count, skin["joints"].size());
    const auto view = index_at(parsed.json["accessors"][*index], "bufferView");
    demand(!view || !parsed.json["bufferViews"][*view].contains("byteStride"), where,
           "is accessor {}, whose buffer view has a byteStride; only vertex attributes may", *index);
    if (view) set_view_usage(parsed, *view, ViewUsage::inverse_bind, where);
    if (accessor.has_no_data() || !seen.insert(*index).second) return;
    for (uint64_t i = 0; i < accessor.count; ++i)
        for (uint32_t row : {3U, 7U, 11U, 15U})
            demand(accessor.raw(i, row) == (row == 15 ? 1 : 0), where,
                   "is accessor {}, whose matrix {} has the last row not 0 0 0 1", *index, i);
}

// A skinned node is only posed where its joints are: in the same scene.
void check_skin_scenes(const Json& document, const std::vector<uint32_t>& parents, const Watch& watch) {
    const Json& nodes = list(document, "nodes");
    // Per root with skinned nodes below: the roots that their joints have, and one such node each.
    std::map<uint32_t, std::map<uint32_t, uint32_t>> needs;
    for (uint32_t i = 0; i < nodes.size(); ++i)
        if (const auto skin = index_at(nodes[i], "skin"))
            needs[root_of(parents, i)].try_emplace(
                root_of(parents, document["skins"][*skin]["joints"][0].get<uint32_t>()), i);
    if (needs.empty()) return;
    for (const Json& scene : list(document, "scenes")) {
        watch.check();
        std::set<uint32_t> roots;
        for (const Json& root : list(scene, "nodes")) roots.insert(root.get<uint32_t>());
        for (const uint32_t root : roots) {
            const auto found = needs.find(root);
            if (found == needs.end()) continue;
            for (const auto& [joint_root, node] : found->second)
                demand(roots.contains(joint_root), pointer("nodes", node),
                       "has a skin whose joints are not in the scene");
        }
    }
}

}  // namespace

void check_nodes(Parsed& parsed, const ReadLimits& limits, const Watch& watch) {
    const Tree tree = tree_of(parsed.json, limits, watch);
    const std::vector<bool> has_joints = meshes_with_joints(parsed.json);
    for (size_t i = 0; i < tree.parents.size(); ++i) {
        watch.check();
        check_transform(parsed, i);
        check_mesh_use(parsed.json, i, has_joints);
    }
    check_scenes(parsed.json, tree.parents, watch);
}

void check_skins(Parsed& parsed, const ReadLimits& limits, const Watch& watch) {
    const Json& skins = list(parsed.json, "skins");
    if (skins.empty()) return;
    const Tree tree = tree_of(parsed.json, limits, watch);
    std::set<uint32_t> seen;
    for (size_t i = 0; i < skins.size(); ++i) {
        check_joints(skins[i], tree, pointer("skins", i), watch);
        check_inverse_bind(parsed, skins[i], pointer("skins", i), seen);
    }
    check_skin_scenes(parsed.json, tree.parents, watch);
}

}  // namespace coppice::gltf
