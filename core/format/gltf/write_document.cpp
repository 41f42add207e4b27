#include "core/format/gltf/write_document.h"

#include <algorithm>
#include <set>

#include "core/base/error.h"
#include "core/format/gltf/described.h"
#include "core/format/gltf/document.h"
#include "core/format/gltf/drawable_materials.h"
#include "core/format/gltf/fresh_document.h"
#include "core/format/gltf/glb.h"
#include "core/format/gltf/gltf.h"
#include "core/format/gltf/parsed.h"
#include "core/format/gltf/structural_metadata.h"
#include "core/format/gltf/write_buffer.h"
#include "core/format/gltf/write_images.h"
#include "core/format/gltf/write_mesh.h"
#include "core/format/gltf/write_nodes.h"
#include "core/scene/expand.h"

namespace coppice::gltf {

namespace {

bool declares(const Json& document, const char* list_name, std::string_view name) {
    const Json& names = list(document, list_name);
    return std::find(names.begin(), names.end(), name) != names.end();
}

void set_declared(Json& document, const char* list_name, const char* name, bool is_declared) {
    Json names = list(document, list_name);
    names.erase(std::remove(names.begin(), names.end(), Json(name)), names.end());
    if (is_declared) names.push_back(name);
    if (names.empty())
        document.erase(list_name);
    else
        document[list_name] = std::move(names);
}

// Of the source, what is not made anew. Its buffer views are listed until the buffer is finished: indices of
// metadata are checked against them.
Json passed_on(const Json& source) {
    Json out = Json::object();
    for (const auto& [key, value] : source.get_ref<const Json::object_t&>())
        if (key != "meshes" && key != "nodes" && key != "accessors") out[key] = value;
    return out;
}

class DocumentWriter {
  public:
    DocumentWriter(const Scene& scene, const WriteOptions& options, const Watch& watch)
        : scene_(scene),
          options_(options),
          watch_(watch),
          buffer_(watch),
          source_(dynamic_cast<const GltfDocument*>(scene.source.get())) {}

    WrittenDocument write(Images images) {
        out_.json = source_ != nullptr ? passed_on(source_->json) : fresh_document(scene_);
        if (keeps_indices())
            buffer_.keep(list(source_->json, "accessors"), list(source_->json, "bufferViews"),
                         source_->buffer_views);
        write_meshes();
        write_scene_nodes();
        pass_animations_and_skins();
        pass_metadata();
        out_.images = write_images(scene_.images, out_.json, buffer_, images == Images::as_files);
        out_.buffer = buffer_.finish(out_.json);
        declare_extensions();
        for (const std::string& name : dropped_)
            out_.warnings.push_back(
                {"extension.dropped",
                 fmt::format("the extension {} described what is no longer there, and was left out", name)});
        return std::move(out_);
    }

  private:
    bool keeps_indices() const { return source_ != nullptr && source_->keeps_indices; }

    // Index in the result of a source accessor that is passed through.
    uint32_t pass(uint32_t index) {
        if (keeps_indices() && !source_->repaired.contains(index)) return index;
        const auto [known, is_new] = passed_.try_emplace(index, 0);
        if (!is_new) return known->second;
        const Json& from = source_->json["accessors"][index];
        Json more = Json::object();
        for (const char* kept : {"name", "extras", "extensions"})
            if (from.contains(kept)) more[kept] = from[kept];
        const bool bounds = from.contains("min") || from.contains("max");
        if (source_->accessors.contains(index))
            known->second = buffer_.add(passed_accessor(index), kind_, bounds, more);
        else
            known->second = buffer_.add_without_data(from);
        return known->second;
    }

    Accessor passed_accessor(uint32_t index) const {
        Accessor accessor = described(source_->json["accessors"][index]);
        accessor.bytes = source_->accessors.at(index);
        accessor.stride = accessor.tight_stride();
        return accessor;
    }

    std::function<uint32_t(uint32_t)> passer(BufferWriter::Kind kind) {
        return [this, kind](uint32_t index) {
            kind_ = kind;
            return pass(index);
        };
    }

    void write_meshes() {
        MeshContext context{buffer_,
                            declares(out_.json, "extensionsRequired", "KHR_mesh_quantization"),
                            {},
                            dropped_,
                            watch_};
        // Points and lines: an accessor is either indices or vertices, never both.
        context.pass_accessor = [this](uint32_t index) {
            kind_ = is_index_accessor(index) ? BufferWriter::Kind::indices : BufferWriter::Kind::vertices;
            return pass(index);
        };
        for (const Mesh& mesh : scene_.meshes) {
            watch_.check();
            const Json* from = nullptr;
            if (source_ != nullptr && mesh.source_mesh &&
                *mesh.source_mesh < list(source_->json, "meshes").size())
                from = &source_->json["meshes"][*mesh.source_mesh];
            const uint64_t before = buffer_.size();
            out_.json["meshes"].push_back(write_mesh(mesh, from, context));
            out_.mesh_bytes.push_back(buffer_.size() - before);
        }
    }

    bool is_index_accessor(uint32_t index) {
        if (!index_accessors_) {
            index_accessors_.emplace();
            for (const Json& mesh : list(source_->json, "meshes"))
                for (const Json& primitive : mesh["primitives"])
                    if (const auto indices = index_at(primitive, "indices"))
                        index_accessors_->insert(*indices);
        }
        return index_accessors_->contains(index);
    }

    void write_scene_nodes() {
        NodeContext context{source_, buffer_, passer(BufferWriter::Kind::data), dropped_, {}};
        write_nodes(scene_, out_.json, context, watch_);
        uses_instancing_ = context.uses_instancing;
        for (const std::string& name : context.lost_attributes)
            out_.warnings.push_back(
                {"format.lost",
                 fmt::format("instances that are nodes have no attributes: {} was left out", name)});
    }

    void pass_animations_and_skins() {
        if (source_ == nullptr) return;
        const auto pass_data = passer(BufferWriter::Kind::data);
        const auto pass_bind = passer(BufferWriter::Kind::inverse_bind);
        if (out_.json.contains("animations"))
            for (Json& animation : out_.json["animations"])
                for (Json& sampler : animation["samplers"])
                    for (const char* end : {"input", "output"})
                        sampler[end] = pass_data(sampler[end].get<uint32_t>());
        if (out_.json.contains("skins"))
            for (Json& skin : out_.json["skins"])
                if (skin.contains("inverseBindMatrices"))
                    skin["inverseBindMatrices"] = pass_bind(skin["inverseBindMatrices"].get<uint32_t>());
    }

    void pass_metadata() {
        if (source_ == nullptr || keeps_indices()) return;
        std::map<uint32_t, uint32_t> views;
        for_each_metadata_view(out_.json, [&](uint32_t view, const Pointer&) {
            const auto [known, is_new] = views.try_emplace(view, 0);
            if (is_new) known->second = buffer_.add_view(source_->buffer_views.at(view));
            return known->second;
        });
    }

    void declare_extensions() {
        for (const char* decoded : {"KHR_draco_mesh_compression", "EXT_meshopt_compression"})
            for (const char* names : {"extensionsUsed", "extensionsRequired"})
                set_declared(out_.json, names, decoded, false);
        for (const std::string& name : dropped_)
            for (const char* names : {"extensionsUsed", "extensionsRequired"})
                set_declared(out_.json, names, name.c_str(), false);
        constexpr const char* instancing = "EXT_mesh_gpu_instancing";
        const bool was_used = declares(out_.json, "extensionsUsed", instancing);
        const bool was_required = declares(out_.json, "extensionsRequired", instancing);
        // Without the extension a viewer would draw one instance of many: so it is required, unless the
        // source had it otherwise.
        set_declared(out_.json, "extensionsRequired", instancing,
                     uses_instancing_ && (was_required || !was_used));
        set_declared(out_.json, "extensionsUsed", instancing, uses_instancing_);
    }

    const Scene& scene_;
    const WriteOptions& options_;
    const Watch& watch_;
    BufferWriter buffer_;
    const GltfDocument* source_;
    WrittenDocument out_;
    BufferWriter::Kind kind_ = BufferWriter::Kind::data;  // of the accessor that is passed next
    std::map<uint32_t, uint32_t> passed_;
    std::optional<std::set<uint32_t>> index_accessors_;
    std::set<std::string> dropped_;
    bool uses_instancing_ = false;
};

}  // namespace

WrittenDocument write_document(const Scene& scene, const WriteOptions& options, Images images,
                               const Watch& watch) {
    std::vector<Warning> warnings;
    std::optional<Scene> changed;
    if (dynamic_cast<const GltfDocument*>(scene.source.get()) == nullptr)
        changed = with_drawable_materials(scene, warnings);
    if (options.instancing == Instancing::expand) changed = expand_meshes(changed ? *changed : scene);
    if (options.instancing == Instancing::nodes) {
        if (!changed) changed = scene;
        unfold_batches(*changed);
    }
    WrittenDocument out = DocumentWriter(changed ? *changed : scene, options, watch).write(images);
    out.warnings.insert(out.warnings.begin(), warnings.begin(), warnings.end());
    return out;
}

}  // namespace coppice::gltf

namespace coppice {

WrittenAsset write_glb(const Scene& scene, const WriteOptions& options, const Watch& watch) {
    gltf::WrittenDocument written = gltf::write_document(scene, options, gltf::Images::embedded, watch);
    return {gltf::print_glb(gltf::print_json(written.json, watch), written.buffer, watch),
            "model/gltf-binary", "glb", std::move(written.mesh_bytes), std::move(written.warnings)};
}

GltfFiles write_gltf(const Scene& scene, const WriteOptions& options, const Watch& watch) {
    gltf::WrittenDocument written = gltf::write_document(scene, options, gltf::Images::as_files, watch);
    GltfFiles out;
    out.mesh_bytes = std::move(written.mesh_bytes);
    out.warnings = std::move(written.warnings);
    const std::string binary = options.base_name + ".bin";
    if (!written.buffer.empty()) written.json["buffers"][0]["uri"] = binary;
    out.files.push_back({options.base_name + ".gltf", to_bytes(gltf::print_json(written.json, watch))});
    if (!written.buffer.empty()) out.files.push_back({binary, std::move(written.buffer)});
    for (NamedFile& image : written.images) out.files.push_back(std::move(image));
    return out;
}

}  // namespace coppice
