#include "core/format/gltf/write_nodes.h"

#include <algorithm>
#include <deque>
#include <optional>

#include "core/format/gltf/parsed.h"
#include "core/format/gltf/trs.h"

namespace coppice::gltf {

namespace {

void set_trs(Json& node, const Trs& trs) {
    for (const char* part : {"matrix", "translation", "rotation", "scale"}) node.erase(part);
    const auto [t, r, s] = trs;
    if (t != Vec3d{0, 0, 0}) node["translation"] = {t.x, t.y, t.z};
    if (r != std::array<double, 4>{0, 0, 0, 1}) node["rotation"] = r;
    if (s != Vec3d{1, 1, 1}) node["scale"] = {s.x, s.y, s.z};
}

// A translation, rotation and scale for each instance, or nothing where one of them shears.
std::optional<std::vector<Trs>> decompose_all(const std::vector<Transform>& batch) {
    std::vector<Trs> out;
    for (const Transform& transform : batch) {
        const auto trs = decompose(transform);
        if (!trs) return std::nullopt;
        out.push_back(*trs);
    }
    return out;
}

template <typename ValueAt>
uint32_t add_instances(BufferWriter& buffer, uint32_t components, size_t count, const ValueAt& value) {
    Bytes bytes;
    for (size_t i = 0; i < count; ++i)
        for (uint32_t c = 0; c < components; ++c)
            append_component(bytes, value(i, c), ComponentType::float32);
    Accessor accessor;
    accessor.rows = components;
    accessor.count = count;
    accessor.bytes = bytes;
    accessor.stride = accessor.tight_stride();
    return buffer.add(accessor, BufferWriter::Kind::data, false);
}

double component(Vec3d v, uint32_t c) {
    return c == 0 ? v.x : c == 1 ? v.y : v.z;
}

Json batch_json(BufferWriter& buffer, const std::vector<Trs>& batch) {
    const size_t n = batch.size();
    Json attributes = {{"TRANSLATION", add_instances(buffer, 3, n, [&](size_t i, uint32_t c) {
                            return component(batch[i].translation, c);
                        })}};
    if (std::any_of(batch.begin(), batch.end(), [](const Trs& t) { return t.rotation != Trs{}.rotation; }))
        attributes["ROTATION"] =
            add_instances(buffer, 4, n, [&](size_t i, uint32_t c) { return batch[i].rotation[c]; });
    if (std::any_of(batch.begin(), batch.end(), [](const Trs& t) { return t.scale != Trs{}.scale; }))
        attributes["SCALE"] =
            add_instances(buffer, 3, n, [&](size_t i, uint32_t c) { return component(batch[i].scale, c); });
    return {{"attributes", attributes}};
}

class NodeWriter {
  public:
    NodeWriter(const Scene& scene, NodeContext& context, const Watch& watch)
        : scene_(scene),
          context_(context),
          watch_(watch),
          out_(Json::array()),
          next_(static_cast<uint32_t>(scene.nodes.size())) {}

    Json write() {
        for (uint32_t i = 0; i < scene_.nodes.size(); ++i) {
            watch_.check();
            out_.push_back(write_node(i));
        }
        for (Json& inner : appended_) out_.push_back(std::move(inner));
        return std::move(out_);
    }

  private:
    const Node* before(uint32_t i) const {
        const bool is_known = context_.source != nullptr && i < context_.source->nodes.size();
        return is_known ? &context_.source->nodes[i] : nullptr;
    }

    Json write_node(uint32_t i) {
        const Node& node = scene_.nodes[i];
        const Node* was = before(i);
        Json json = was != nullptr ? context_.source->json["nodes"][i] : Json::object();
        if (!node.name.empty()) json["name"] = node.name;
        if (was == nullptr || was->children != node.children) {
            json.erase("children");
            if (!node.children.empty()) json["children"] = node.children;
        }
        json.erase("mesh");
        Json* carrier = &json;  // which has mesh and children
        if (was == nullptr || was->local != node.local)
            carrier = place(json, node.local, pointer("nodes", i));
        if (node.mesh)
            (*carrier)["mesh"] = *node.mesh;
        else
            for (const char* of_mesh : {"skin", "weights"}) json.erase(of_mesh);
        write_batch(*carrier, node, was);
        return json;
    }

    // Gives the node its transform. Where it shears, an inner node takes over children and mesh; returns it
    // then.
    Json* place(Json& json, const Transform& transform, const Pointer& where) {
        if (const auto trs = decompose(transform)) {
            set_trs(json, *trs);
            return &json;
        }
        const auto both = decompose_in_two(transform);
        demand(both.has_value(), where, "has a transform that is singular: it flattens what it places");
        set_trs(json, both->first);
        appended_.push_back(Json::object());
        Json& inner = appended_.back();
        set_trs(inner, both->second);
        if (json.contains("children")) inner["children"] = json["children"];
        json["children"] = {next_++};
        return &inner;
    }

    void write_batch(Json& json, const Node& node, const Node* was) {
        constexpr const char* name = "EXT_mesh_gpu_instancing";
        if (was != nullptr && !was->batch.empty() && was->batch == node.batch &&
            extension(json, name) != nullptr) {
            for (auto& [attribute, index] : json["extensions"][name]["attributes"].items())
                index = context_.pass_accessor(index.get<uint32_t>());
            context_.uses_instancing = true;
            return;
        }
        if (const Json* lost = extension(json, name)) {
            for (const auto& [attribute, index] : (*lost)["attributes"].get_ref<const Json::object_t&>())
                if (attribute.starts_with('_')) context_.lost_attributes.insert(attribute);
            json["extensions"].erase(name);
            if (json["extensions"].erase("EXT_instance_features") > 0)
                context_.dropped.insert("EXT_instance_features");
            if (json["extensions"].empty()) json.erase("extensions");
        }
        if (node.batch.empty()) return;
        if (const auto batch = decompose_all(node.batch)) {
            json["extensions"][name] = batch_json(context_.buffer, *batch);
            context_.uses_instancing = true;
            return;
        }
        as_children(json, node);
    }

    // Instances that shear cannot be in a batch.
    void as_children(Json& json, const Node& node) {
        const Json mesh = json["mesh"];
        json.erase("mesh");
        for (const Transform& transform : node.batch) {
            Json child = Json::object();
            const uint32_t index = next_++;
            appended_.emplace_back();  // its place; an inner node comes after it
            const size_t at = appended_.size() - 1;
            (*place(child, transform, pointer("nodes", index)))["mesh"] = mesh;
            appended_[at] = std::move(child);
            json["children"].push_back(index);
        }
    }

    const Scene& scene_;
    NodeContext& context_;
    const Watch& watch_;
    Json out_;
    std::deque<Json> appended_;
    uint32_t next_;
};

}  // namespace

void write_nodes(const Scene& scene, Json& document, NodeContext& context, const Watch& watch) {
    if (!scene.nodes.empty()) document["nodes"] = NodeWriter(scene, context, watch).write();
}

}  // namespace coppice::gltf
