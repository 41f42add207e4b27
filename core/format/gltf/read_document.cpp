#include "core/format/gltf/read_document.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <set>

#include "core/format/gltf/checks.h"
#include "core/format/gltf/read_primitive.h"
#include "core/format/gltf/structural_metadata.h"

namespace coppice::gltf {

namespace {

void insert_all(const Json& map, std::set<uint32_t>& out) {
    for (const Json& index : map) out.insert(index.get<uint32_t>());
}

// Accessors that the writer cannot make anew from the scene.
std::set<uint32_t> passed_through(const Json& document) {
    std::set<uint32_t> out;
    for (const Json& skin : list(document, "skins"))
        if (const auto index = index_at(skin, "inverseBindMatrices")) out.insert(*index);
    for (const Json& animation : list(document, "animations"))
        for (const Json& sampler : animation["samplers"])
            for (const char* end : {"input", "output"}) out.insert(*index_at(sampler, end));
    for (const Json& node : list(document, "nodes"))
        if (const Json* instancing = extension(node, "EXT_mesh_gpu_instancing"))
            insert_all((*instancing)["attributes"], out);
    for (const Json& mesh : list(document, "meshes"))
        for (const Json& primitive : mesh["primitives"]) {
            if (is_triangles(primitive)) continue;
            insert_all(primitive["attributes"], out);
            for (const Json& target : list(primitive, "targets")) insert_all(target, out);
            if (const auto indices = index_at(primitive, "indices")) out.insert(*indices);
        }
    return out;
}

// The values of an element; scaled to length 1 over the first `unit` components, where they are not.
std::array<double, 16> element(const Accessor& accessor, uint64_t i, const ValueRepair& repair,
                               uint32_t unit) {
    std::array<double, 16> stored{};
    double sum = 0;
    for (uint32_t c = 0; c < accessor.components(); ++c) {
        stored[c] = accessor.raw(i, c);
        if (repair.zero_non_finite && !std::isfinite(stored[c])) stored[c] = 0;
        const double v = decoded(stored[c], accessor.storage);
        if (c < unit) sum += v * v;
    }
    const double length = std::sqrt(sum);
    if (unit == 0 || std::abs(length - 1) <= 0.0067) return stored;
    for (uint32_t c = 0; c < unit; ++c) {
        // What has no direction gets one.
        const double v = length > 0 ? decoded(stored[c], accessor.storage) / length : c == 2 ? 1 : 0;
        stored[c] = encoded(v, accessor.storage);
    }
    return stored;
}

Bytes packed(const Accessor& accessor, const ValueRepair& repair) {
    Bytes out;
    out.reserve(accessor.count * accessor.tight_stride());
    for (uint64_t i = 0; i < accessor.count; ++i) {
        uint32_t unit = 0;
        if (repair.unit_vector) unit = 3;
        if (repair.unit_quaternion && (!repair.cubic || i % 3 == 1)) unit = 4;
        const std::array<double, 16> stored = element(accessor, i, repair, unit);
        for (uint32_t c = 0; c < accessor.components(); ++c) {
            append_component(out, stored[c], accessor.storage.type);
            const bool ends_column = accessor.columns > 1 && (c + 1) % accessor.rows == 0;
            while (ends_column && out.size() % 4 != 0) out.push_back(std::byte{0});
        }
    }
    return out;
}

// Views may share their bytes, and each gets a copy.
void keep_view(const Parsed& parsed, uint32_t index, const ReadLimits& limits, GltfDocument& document) {
    const ByteView bytes = parsed.views[index];
    const auto [at, is_new] = document.buffer_views.try_emplace(index);
    if (!is_new) return;
    document.view_bytes += bytes.size();
    require(document.view_bytes <= limits.zip_bytes, ErrorCode::asset_too_large,
            pointer("bufferViews", index),
            "the buffer views that extensions refer to have more than {} bytes (limit zip_bytes)",
            limits.zip_bytes);
    at->second.assign(bytes.begin(), bytes.end());
}

}  // namespace

std::shared_ptr<GltfDocument> make_document(Parsed& parsed, const ReadLimits& limits) {
    auto document = std::make_shared<GltfDocument>();
    document->keeps_indices = !extensions_with_unknown_indices(parsed.json).empty();
    for (const uint32_t index : passed_through(parsed.json)) {
        const Accessor& accessor = parsed.accessors[index];
        // Without data it stays so: zeros would be held against rules that placeholders are not.
        if (accessor.has_no_data()) continue;
        document->accessors.emplace(index, packed(accessor, parsed.repairs[index]));
        if (parsed.repairs[index].any()) document->repaired.insert(index);
    }
    for_each_metadata_view(parsed.json, [&](uint32_t view, const Pointer& where) {
        demand(!parsed.views[view].empty(), where, "refers to buffer view {}, which has no bytes", view);
        keep_view(parsed, view, limits, *document);
        return view;
    });
    if (document->keeps_indices)
        for (uint32_t i = 0; i < parsed.views.size(); ++i) keep_view(parsed, i, limits, *document);
    document->json = std::move(parsed.json);
    // Their bytes are elsewhere by now, and as data URIs they may be all of the document.
    document->json.erase("buffers");
    if (document->json.contains("images"))
        for (Json& image : document->json["images"]) image.erase("uri");
    return document;
}

}  // namespace coppice::gltf
