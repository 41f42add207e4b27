#include "core/optimize/report.h"

#include <algorithm>

#include "core/optimize/summary.h"
#include "core/scene/instance.h"

namespace coppice {

namespace {

// Wedges whose slot has the attribute; a primitive without it left zeros there.
uint64_t wedges_with(const Mesh& mesh, std::string_view name) {
    const auto found = std::find_if(mesh.attributes.begin(), mesh.attributes.end(),
                                    [&](const Attribute& attribute) { return attribute.name == name; });
    if (found == mesh.attributes.end()) return 0;
    const auto attribute = static_cast<size_t>(found - mesh.attributes.begin());
    const auto has = [&](const MaterialSlot& slot) {
        return slot.has_attribute.empty() || slot.has_attribute[attribute];
    };
    if (std::all_of(mesh.slots.begin(), mesh.slots.end(), has)) return mesh.wedge_count();
    std::vector<bool> marked(mesh.wedge_count(), false);
    for (size_t corner = 0; corner < mesh.triangles.size(); ++corner) {
        if (has(mesh.slots[mesh.triangle_slot[corner / 3]])) marked[mesh.triangles[corner]] = true;
    }
    return static_cast<uint64_t>(std::count(marked.begin(), marked.end(), true));
}

}  // namespace

std::vector<uint64_t> instances_per_mesh(const Scene& scene, const Watch& watch) {
    std::vector<uint64_t> counts(scene.meshes.size(), 0);
    for (const Instance& instance : instances(scene, watch)) ++counts[instance.mesh];
    return counts;
}

uint64_t bytes_of(const Upload& upload) {
    uint64_t bytes = upload.asset.bytes.size();
    for (const UploadedFile& file : upload.resources) bytes += file.bytes.size();
    if (upload.beside != nullptr) bytes += upload.beside->opened_bytes();
    return bytes;
}

uint64_t stored_copies(Format format, uint64_t instances) {
    if (format == Format::obj) return instances;
    return format == Format::iobj && instances == 0 ? 0 : 1;
}

AssetSummary summarize(const Scene& scene, std::span<const uint64_t> instances_of_mesh, Format format,
                       uint64_t bytes) {
    AssetSummary summary{.bytes = bytes, .format = format};
    for (size_t i = 0; i < scene.meshes.size(); ++i) {
        const Mesh& mesh = scene.meshes[i];
        const uint64_t drawn = instances_of_mesh[i], stored = stored_copies(format, drawn);
        summary.meshes += stored;
        summary.instances += drawn;
        summary.unique_triangles += stored * mesh.triangle_count();
        summary.rendered_triangles += drawn * mesh.triangle_count();
        summary.unique_vertices += stored * mesh.vertex_count();
        summary.wedges += stored * mesh.wedge_count();
        summary.texture_coordinates += stored * wedges_with(mesh, "TEXCOORD_0");
        summary.normals += stored * wedges_with(mesh, "NORMAL");
    }
    for (const Image& image : scene.images) summary.texture_bytes += image.bytes.size();
    return summary;
}

AssetSummary summarize(const Scene& scene, Format format, uint64_t bytes) {
    return summarize(scene, instances_per_mesh(scene), format, bytes);
}

Savings savings(uint64_t input_bytes, uint64_t output_bytes, std::span<const uint64_t> mesh_bytes,
                std::span<const uint64_t> instances_of_mesh) {
    Savings out;
    for (size_t i = 0; i < std::min(mesh_bytes.size(), instances_of_mesh.size()); ++i) {
        if (instances_of_mesh[i] > 1)
            out.bytes_saved_by_instancing += mesh_bytes[i] * (instances_of_mesh[i] - 1);
    }
    const auto ratio = [&](uint64_t whole) {
        return whole == 0 ? 0 : static_cast<double>(output_bytes) / static_cast<double>(whole);
    };
    out.bytes_ratio = ratio(input_bytes);
    out.bytes_vs_expanded = ratio(output_bytes + out.bytes_saved_by_instancing);
    return out;
}

}  // namespace coppice
