#include <algorithm>
#include <set>

#include "core/format/gltf/checks.h"
#include "core/format/gltf/described.h"
#include "core/format/gltf/read_primitive.h"

namespace coppice::gltf {

namespace {

class ClaimsCheck {
  public:
    ClaimsCheck(const Json& document, const ReadLimits& limits, const Watch& watch)
        : document_(document), limits_(limits), watch_(watch) {}

    void run() {
        for (size_t i = 0; i < list(document_, "accessors").size(); ++i) {
            watch_.check();
            add_bytes(bytes_of(accessor(i)), pointer("accessors", i));
        }
        const Json& meshes = list(document_, "meshes");
        for (size_t m = 0; m < meshes.size(); ++m) {
            streams_.clear();
            for (size_t p = 0; p < meshes[m]["primitives"].size(); ++p)
                primitive(meshes[m]["primitives"][p], pointer("meshes", m, "primitives", p));
        }
    }

  private:
    // One that claims more than its buffer view holds is refused for that, later.
    Accessor accessor(size_t index) const {
        const Json& json = document_["accessors"][index];
        Accessor out = described(json);
        if (const auto view = index_at(json, "bufferView"))
            out.count = std::min(out.count, view_bytes(*view) / out.element_size() + 1);
        return out;
    }

    uint64_t view_bytes(uint32_t view) const {
        return unsigned_at(document_["bufferViews"][view], "byteLength");
    }

    void primitive(const Json& primitive, const Pointer& where) {
        watch_.check();
        const bool is_draco = extension(primitive, "KHR_draco_mesh_compression") != nullptr;
        if (is_draco) add_draco(primitive, where);
        if (const auto positions = index_at(primitive["attributes"], "POSITION"))
            if (is_draco || positions_.insert(*positions).second)
                add_vertices(accessor(*positions).count, where);
        if (is_triangles(primitive)) add_triangles(primitive, where);
        add_streams(primitive["attributes"], 0, where);
        const Json& targets = list(primitive, "targets");
        for (size_t t = 0; t < targets.size(); ++t) add_streams(targets[t], t + 1, where);
    }

    // No overflow: the schema bounds counts to 2^53.
    static uint64_t bytes_of(const Accessor& accessor) { return accessor.count * accessor.tight_stride(); }

    void add_bytes(uint64_t bytes, const Pointer& where) {
        require(bytes <= limits_.attribute_bytes - bytes_, ErrorCode::asset_too_large, where,
                "the accessors hold more than {} bytes (limit attribute_bytes)", limits_.attribute_bytes);
        bytes_ += bytes;
    }

    // Each use of a stream is decoded, so each counts.
    void add_draco(const Json& primitive, const Pointer& where) {
        for (const Json& index : primitive["attributes"])
            add_bytes(bytes_of(accessor(index.get<size_t>())), where);
        const auto view = *index_at(*extension(primitive, "KHR_draco_mesh_compression"), "bufferView");
        add_bytes(view_bytes(view), where);
    }

    void add_vertices(uint64_t count, const Pointer& where) {
        require(count <= limits_.vertices - vertices_, ErrorCode::asset_too_large, where,
                "the meshes have more than {} vertices (limit vertices)", limits_.vertices);
        vertices_ += count;
    }

    void add_triangles(const Json& primitive, const Pointer& where) {
        const auto indices = index_at(primitive, "indices");
        const uint64_t corners =
            accessor(indices ? *indices : *index_at(primitive["attributes"], "POSITION")).count;
        const uint64_t count = unsigned_at(primitive, "mode", 4) == 4 ? corners / 3 : corners;
        require(count <= limits_.triangles - triangles_, ErrorCode::asset_too_large, where,
                "the meshes have more than {} triangles (limit triangles)", limits_.triangles);
        triangles_ += count;
    }

    // All vertices of a mesh have all attributes that one of its primitives has.
    void add_streams(const Json& attributes, size_t target, const Pointer& where) {
        for (const auto& [name, index] : attributes.get_ref<const Json::object_t&>())
            streams_.emplace(target, name);
        require(streams_.size() <= limits_.attributes, ErrorCode::asset_too_large, where,
                "the mesh has more than {} attributes, with those of its morph targets (limit attributes)",
                limits_.attributes);
    }

    const Json& document_;
    const ReadLimits& limits_;
    const Watch& watch_;
    uint64_t bytes_ = 0;
    uint64_t vertices_ = 0;
    uint64_t triangles_ = 0;
    std::set<uint32_t> positions_;                           // accessors that were counted
    std::set<std::pair<size_t, std::string_view>> streams_;  // of one mesh: 0 or the target + 1, and the name
};

}  // namespace

void check_claims(const Json& document, const ReadLimits& limits, const Watch& watch) {
    ClaimsCheck(document, limits, watch).run();
}

}  // namespace coppice::gltf
